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

}  // namespace

int run_command(const Arguments& arguments) {
  const RunOptions options = parse_run_options(arguments);
  check_before_run(options);
  const SignalsEndLiveInput on_signal(options);

  RunResults results(options, options.events, options.view);
  ProgressBar bar(!options.quiet, "step");
  RunReport report = run_scene(
      options,
      [&bar](std::size_t done, double within, std::size_t total) { bar.update(done, within, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); }, results);
  bar.erase();
  results.add_distributions(report);
  results.deliver(report, report_json(report), comparison_table(report));
  return 0;
}

}  // namespace kds
