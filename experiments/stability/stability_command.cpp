#include "experiments/stability/stability_command.h"

#include <stdexcept>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/stability/parse_stability_options.h"
#include "experiments/stability/run_stability.h"
#include "experiments/stability/stability_page.h"
#include "experiments/stability/stability_report.h"
#include "experiments/stability/stability_table.h"

namespace kds {

int stability_command(const Arguments& arguments) {
  const StabilityOptions options = parse_stability_options(arguments);
  const Destinations destinations{options.out, options.json, options.quiet};
  const std::string name = "stability";
  TakenPaths taken;
  if (options.out) taken.write_into("--out", *options.out, {"report.html"});
  check_table_destinations(destinations, name, taken);
  if (options.out) {
    check_page(*options.out, "stability");
  }

  ProgressBar bar(!options.quiet, "row");
  const std::vector<StabilityRow> rows =
      run_stability(options, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  const std::string command_line = "kds stability " + shell_words(arguments);
  deliver_table(
      destinations, name,
      {stability_json(command_line, options, rows), stability_csv(rows), stability_table(rows),
       [&] { return stability_page(rows, made_by(name, command_line, stability_settings(options))); }});

  if (const auto complaint = complaint_about(rows)) throw std::runtime_error(*complaint);
  return 0;
}

}  // namespace kds
