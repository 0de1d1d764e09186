#include "experiments/program/commands.h"

#include "experiments/output/output_files.h"
#include "experiments/program/input_options.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_scene.h"

namespace kds {
namespace {

void check_before_run(const RunOptions& options) {
  check_inputs_exist(options);
  TakenPaths paths;
  paths.read(options);
  paths.write(options);
  if (options.dump) paths.write_into("--dump", *options.dump);
  paths.require_directory(options.replace);
  if (options.events) paths.write("--events", *options.events);
  if (options.log) paths.write("--log", *options.log);
  if (options.view) paths.write_page(*options.view, options);
  check_writable(options);
  if (options.dump) check_directory(*options.dump, "--dump", options.replace);
  if (options.events) ensure_writable_file(*options.events, "--events");
  if (options.log) ensure_writable_file(*options.log, "--log");
}

Json settings_of(const RunOptions& options) {
  Json settings = Json::object();
  for (const auto& [name, value] : run_options().settings(options)) settings[name] = value;
  return settings;
}

}  // namespace

int run_command(const Arguments& arguments) {
  RunOptions options = parse_run_options(arguments);
  std::optional<std::string> part;
  if (options.continues) part = start_part("summary.json", settings_of(options), options);
  check_before_run(options);
  const SignalsEndLiveInput on_signal(options);

  RunResults results(options, options.events, options.view);
  ProgressBar bar(!options.quiet, "step");
  if (part) print_note(bar, *part);
  options.reading.on_wait = waiting_note(bar, options);
  ResultsSoFar regularly(bar, options.every);
  RunReport report = run_scene(
      options,
      [&bar](std::size_t done, double within, std::size_t total) { bar.update(done, within, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); }, results,
      regularly.hooks<RunReport>(options.out.has_value(), [&results](RunReport so_far) {
        results.add_distributions(so_far);
        return results.deliver_so_far(report_json(so_far));
      }));
  bar.erase();
  results.add_distributions(report);
  results.deliver(report, report_json(report), comparison_table(report));
  return report.live ? end_of_live_run(bar, *report.live, report.truncated) : 0;
}

}  // namespace kds
