#include "experiments/run_command.h"

#include <fmt/format.h>

#include <filesystem>

#include "experiments/output_files.h"
#include "experiments/parse_run_options.h"
#include "experiments/progress_bar.h"
#include "experiments/report_json.h"
#include "experiments/run_results.h"
#include "experiments/run_scene.h"
#include "experiments/table.h"
#include "experiments/taken_paths.h"
#include "experiments/warnings.h"
#include "motions/input_error.h"

namespace kds {
namespace {

namespace fs = std::filesystem;

void check_exists(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (fs::is_directory(path, error))
    throw InputError(fmt::format("{}: is a directory, expected a file", path.string()));
}

void check_apart(const RunOptions& options, const Destinations& destinations) {
  TakenPaths paths;
  for (const fs::path& input : options.inputs) paths.add("an input", input);
  if (options.reading.topology) paths.add("--topology", *options.reading.topology);
  constexpr std::string_view file = "file:";
  if (options.radius.starts_with(file)) paths.add("--radius", options.radius.substr(file.size()));
  paths.write(destinations);
  if (options.log) paths.write("--log", *options.log);
}

void check_before_run(const RunOptions& options, const Destinations& destinations) {
  for (const fs::path& input : options.inputs) check_exists(input);
  if (options.reading.topology) check_exists(*options.reading.topology);
  check_apart(options, destinations);
  check_destinations(destinations);
  if (options.log) ensure_writable_file(*options.log, "--log");
  if (options.dump) ensure_directory(*options.dump, "--dump");
}

}  // namespace

int run_command(const Arguments& arguments) {
  const RunOptions options = parse_run_options(arguments);
  const Destinations destinations{options.out, options.json, options.quiet};
  check_before_run(options, destinations);

  ProgressBar bar(!options.quiet);
  const RunReport report = run_scene(
      options, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); });
  bar.erase();
  deliver(destinations, report, report_json(report), comparison_table(report));
  return 0;
}

}  // namespace kds
