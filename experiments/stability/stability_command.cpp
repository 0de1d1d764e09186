#include "experiments/stability/stability_command.h"

#include <stdexcept>

#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/stability/parse_stability_options.h"
#include "experiments/stability/run_stability.h"
#include "experiments/stability/stability_report.h"
#include "experiments/stability/stability_table.h"

namespace kds {

int stability_command(const Arguments& arguments) {
  const StabilityOptions options = parse_stability_options(arguments);
  const Destinations destinations{options.out, options.json, options.quiet};
  const std::string name = "stability";
  check_table_destinations(destinations, name);

  ProgressBar bar(!options.quiet);
  const std::vector<StabilityRow> rows =
      run_stability(options, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  deliver_table(destinations, name,
                {stability_json(options, rows), stability_csv(rows), stability_table(rows)});

  if (const auto complaint = complaint_about(rows)) throw std::runtime_error(*complaint);
  return 0;
}

}  // namespace kds
