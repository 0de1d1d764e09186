#include "experiments/program/commands.h"

#include <stdexcept>

#include "experiments/program/table_command.h"
#include "experiments/stability/run_stability.h"
#include "experiments/stability/stability_options.h"
#include "experiments/stability/stability_page.h"
#include "experiments/stability/stability_report.h"
#include "experiments/stability/stability_table.h"

namespace kds {

int stability_command(const Arguments& arguments) {
  const StabilityOptions options = parse_stability_options(arguments);
  TableCommand command("stability", arguments, options, "row");
  command.check_destinations();

  const std::vector<StabilityRow> rows = run_stability(options, command.progress());
  command.bar().erase();
  command.deliver_text(stability_json(command.command_line(), options, rows),
                       stability_options().settings_json(options), {{"stability.csv", stability_csv(rows)}},
                       stability_table(rows),
                       [&](Page page) { return stability_page(rows, std::move(page)); });

  if (const auto complaint = complaint_about(rows)) throw std::runtime_error(*complaint);
  return 0;
}

}  // namespace kds
