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

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) ||
         fs::absolute(a, error).lexically_normal() == fs::absolute(b, error).lexically_normal();
}

// A result must not replace what it was computed from, nor another result.
void check_apart(const RunOptions& options) {
  std::vector<std::pair<std::string, fs::path>> taken;
  for (const fs::path& input : options.inputs) taken.emplace_back("an input", input);
  if (options.reading.topology) taken.emplace_back("--topology", *options.reading.topology);
  const auto take = [&taken](const std::string& option, const fs::path& path) {
    std::error_code error;
    if (fs::exists(path, error) && fs::is_character_file(path, error)) return;  // /dev/null is for all
    for (const auto& [owner, other] : taken)
      if (same_file(path, other))
        throw InputError(fmt::format("{} {}: is the file of {}", option, path.string(), owner));
    taken.emplace_back(option, path);
  };
  if (options.json && *options.json != "-") take("--json", *options.json);
  if (options.log) take("--log", *options.log);
}

void check_before_run(const RunOptions& options, const Destinations& destinations) {
  for (const fs::path& input : options.inputs) check_exists(input);
  if (options.reading.topology) check_exists(*options.reading.topology);
  check_apart(options);
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
