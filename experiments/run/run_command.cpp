#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/events/event_files.h"
#include "experiments/output/output_files.h"
#include "experiments/program/input_options.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

namespace fs = std::filesystem;

/// Throws InputError if a result would be a file of --dump. A dump owns its files in the folder: it replaces
/// the frames and contacts.csv of an earlier dump.
void refuse_file_in(const std::filesystem::path& dump, const RunOptions& options) {
  const auto refuse = [&](const char* option, const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    std::error_code error;
    const bool inside =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path(), error) ==
        std::filesystem::weakly_canonical(std::filesystem::absolute(dump), error);
    if (inside && (name.starts_with("frame-") || name == contacts_file))
      throw InputError(fmt::format("{} {}: is a file of --dump", option, file.string()));
  };
  if (options.events) refuse("--events", *options.events);
  if (options.log) refuse("--log", *options.log);
  if (options.view) refuse("--view", *options.view);
  if (options.json && *options.json != "-") refuse("--json", *options.json);
}

void check_apart(const RunOptions& options, const Destinations& destinations) {
  TakenPaths paths;
  paths.read(options);
  paths.write(destinations);
  if (options.events) paths.write("--events", *options.events);
  if (options.log) paths.write("--log", *options.log);
  if (options.view) paths.write("--view", *options.view);
  if (!options.dump) return;
  paths.write_into("--dump", *options.dump);
  if (std::ranges::count(options.structures, "contacts") > 0)  // --out has a contacts.csv too
    paths.write("--dump", *options.dump / contacts_file);
  refuse_file_in(*options.dump, options);
}

void check_before_run(const RunOptions& options, const Destinations& destinations) {
  check_inputs_exist(options);
  check_apart(options, destinations);
  check_destinations(destinations, "run", options);
  if (options.events) ensure_writable_file(*options.events, "--events");
  if (options.log) ensure_writable_file(*options.log, "--log");
  if (options.view) ensure_writable_file(*options.view, "--view");
  if (!options.dump) return;
  check_directory(*options.dump, "run", "--dump");
  if (std::ranges::count(options.structures, "contacts") > 0)
    check_directory(*options.dump, "run", "--dump", {contacts_file});
}

}  // namespace

int run_command(const Arguments& arguments) {
  const RunOptions options = parse_run_options(arguments);
  const Destinations& destinations = options;
  check_before_run(options, destinations);

  RunResults results("run", destinations, options.events, options.view);
  ProgressBar bar(!options.quiet, "step");
  const RunReport report = run_scene(
      options,
      [&bar](std::size_t done, double within, std::size_t total) { bar.update(done, within, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); }, results);
  bar.erase();
  results.deliver(report, report_json(report), comparison_table(report));
  return 0;
}

}  // namespace kds
