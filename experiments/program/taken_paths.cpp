#include "experiments/program/taken_paths.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  // Files that do not exist yet; where a path cannot be followed, opening it will tell.
  const auto place = [](const fs::path& path) {
    std::error_code lost;
    fs::path whole = fs::absolute(path, lost);
    constexpr int most_links = 40;
    for (int links = 0; links < most_links && fs::is_symlink(whole, lost);
         ++links)  // to what is not there yet
      whole = whole.parent_path() / fs::read_symlink(whole, lost);
    const fs::path found = fs::weakly_canonical(whole, lost);
    return (lost ? whole : found).lexically_normal();
  };
  return place(a) == place(b);
}

}  // namespace

void TakenPaths::read(const InputOptions& options) {
  for (const fs::path& input : options.inputs) add("an input", input);
  if (options.reading.topology) add("--topology", *options.reading.topology);
  constexpr std::string_view file = "file:";
  if (options.radius.starts_with(file)) add("--radius", options.radius.substr(file.size()));
}

void TakenPaths::write(const std::string& option, const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return;
  for (const auto& [owner, other] : taken_)
    if (same_file(path, other))
      throw InputError(fmt::format("{} {}: is the file of {}", option, path.string(), owner));
  add(option, path);
}

void TakenPaths::write(const Destinations& destinations) {
  if (destinations.out) {
    for (const char* name : {"summary.json", "events.csv", "contacts.csv", "report.html"})
      write("--out", *destinations.out / name);
  }
  if (destinations.json && *destinations.json != "-") write("--json", *destinations.json);
}

}  // namespace kds
