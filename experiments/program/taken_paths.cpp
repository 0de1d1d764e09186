#include "experiments/program/taken_paths.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

// Returns the absolute path with symbolic links followed, even if the path does not exist yet. If a path
// cannot be resolved, the later attempt to open it reports the error.
fs::path place_of(const fs::path& path) {
  std::error_code lost;
  fs::path whole = fs::absolute(path, lost);
  constexpr int most_links = 40;
  for (int links = 0; links < most_links && fs::is_symlink(whole, lost); ++links)  // missing targets too
    whole = whole.parent_path() / fs::read_symlink(whole, lost);
  const fs::path found = fs::weakly_canonical(whole, lost);
  const fs::path place = (lost ? whole : found).lexically_normal();
  return place.has_filename() ? place : place.parent_path();  // a/ becomes a
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) || place_of(a) == place_of(b);
}

// Returns whether `path` is `directory` or a directory above it.
bool leads_to(const fs::path& path, const fs::path& directory) {
  const fs::path start = place_of(path), whole = place_of(directory);
  return std::mismatch(start.begin(), start.end(), whole.begin(), whole.end()).first == start.end();
}

}  // namespace

void TakenPaths::read(const InputOptions& options) {
  for (const fs::path& input : options.inputs) add("an input", input);
  if (options.reading.topology) add("--topology", *options.reading.topology);
  if (options.obstacle) add("--obstacle", *options.obstacle);
  constexpr std::string_view file = "file:";
  if (options.radius.starts_with(file)) add("--radius", options.radius.substr(file.size()));
}

void TakenPaths::read_folder(const std::string& owner, const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator file(folder, error), end; file != end && !error;
       file.increment(error))
    if (file->is_regular_file(error)) add(owner, file->path());
}

void TakenPaths::write_json(const std::string& destination) {
  if (destination == "-") return write("--json -", "/dev/stdout");
  write("--json", destination);
}

void TakenPaths::write(const std::string& option, const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return;
  for (const auto& [owner, other] : taken_)
    if (same_file(path, other))
      throw InputError(fmt::format("{} {}: is the file of {}", option, path.string(), owner));
  for (const auto& [owner, directory] : directories_)
    if (leads_to(path, directory))
      throw InputError(
          fmt::format("{} {}: is to be a directory, for {} {}, expected another place for the file", option,
                      path.string(), owner, directory.string()));
  add(option, path);
}

void TakenPaths::write_into(const std::string& option, const fs::path& directory,
                            std::initializer_list<std::string_view> names) {
  for (const auto& [owner, file] : taken_)
    if (leads_to(file, directory))
      throw InputError(fmt::format("{} {}: {} is the file of {}, expected a directory", option,
                                   directory.string(), file.string(), owner));
  directories_.emplace_back(option, directory);
  for (const std::string_view name : names) write(option, directory / name);
}

void TakenPaths::write(const Destinations& destinations) {
  if (destinations.out)
    write_into("--out", *destinations.out,
               {"summary.json", "events.csv", "contacts.csv", "possible_contacts.csv", "report.html"});
  if (destinations.json) write_json(*destinations.json);
}

}  // namespace kds
