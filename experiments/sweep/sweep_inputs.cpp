#include "experiments/sweep/sweep_inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glob.h>

#include <algorithm>
#include <memory>
#include <set>

#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

// Returns a pattern that matches the path only.
fs::path as_pattern(const fs::path& path) {
  std::string pattern;
  for (const char c : path.string()) {
    if (std::string_view("*?[\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::set<std::string> matching_files(const std::string& pattern, const fs::path& folder,
                                     const std::string& where) {
  if (pattern.find("**") != std::string::npos)
    throw InputError(fmt::format(
        "{}: '{}': ** is not supported; expected one pattern for each depth of folders", where, pattern));
  glob_t found{};
  const int failed = ::glob(in_folder(as_pattern(folder), pattern).c_str(), 0, nullptr, &found);
  const std::unique_ptr<glob_t, decltype(&::globfree)> owner(&found, &::globfree);
  if (failed == GLOB_NOMATCH) return {};
  if (failed != 0) throw InputError(fmt::format("{}: cannot list the files of '{}'", where, pattern));
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

// Returns the path as sweep.json would give it.
std::string short_name(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return relative.empty() ? file.string() : relative.string();
}

std::vector<SweepInput> inputs_from(const SweptCommand& command, const Json& item, const fs::path& folder,
                                    PatternFiles& patterns, const std::string& where) {
  const Json* files = &item;
  std::vector<std::pair<std::string, AxisValue>> options;
  if (item.members() != nullptr) {
    files = item.find("file");
    if (files == nullptr)
      throw InputError(where +
                       ": an input that is an object needs the key 'file', beside options of the input");
    for (const auto& [key, value] : *item.members()) {
      if (key == "file") continue;
      const std::string name = known_option(command, key, where);
      for (const auto& [other, its_value] : options)
        if (other == name) throw InputError(fmt::format("{}: option {} is listed twice", where, name));
      options.emplace_back(name, read_value(command, name, value, folder, fmt::format("{}: {}", where, key)));
    }
  }
  std::vector<SweepInput> inputs;
  if (files->items() != nullptr) {  // several files of one task
    SweepInput input{{}, {}, options};
    std::vector<std::string> names;
    for (const Json& file : *files->items()) {
      names.push_back(scalar_text(file, where));
      if (names.back().empty()) throw InputError(where + ": 'file' lists an empty path");
      input.files.push_back(in_folder(folder, names.back()).string());
    }
    if (names.empty()) throw InputError(where + ": 'file' lists no file");
    input.name = fmt::format("{}", fmt::join(names, " "));
    return {input};
  }
  if (files->text() == nullptr || files->text()->empty())
    throw InputError(where + ": expected a path, or an object with the key 'file'");
  const std::string path = scalar_text(*files, where);
  const std::string whole = in_folder(folder, path).string();
  for (const std::string& file : patterns.of(path, folder, where))
    inputs.push_back({file == whole ? path : short_name(file, folder), {file}, options});
  return inputs;
}

}  // namespace

PatternFiles::PatternFiles(const Json& remembered) {
  if (remembered.members() == nullptr) return;
  for (const auto& [pattern, files] : *remembered.members()) {
    if (files.items() == nullptr) continue;
    for (const Json& file : *files.items())
      if (file.text() != nullptr) remembered_[pattern].push_back(*file.text());
  }
}

std::vector<std::string> PatternFiles::of(const std::string& pattern, const fs::path& folder,
                                          const std::string& where) {
  const fs::path whole = in_folder(folder, pattern);
  if (pattern.find_first_of("*?[") == std::string::npos) return {whole.string()};
  std::error_code none;
  std::set<std::string> files;
  if (const auto earlier = remembered_.find(pattern); earlier != remembered_.end())
    files = {earlier->second.begin(), earlier->second.end()};
  if (fs::exists(whole, none))
    files.insert(whole.string());
  else if (files != std::set{whole.string()})  // a file of this name that is gone
    files.merge(matching_files(pattern, folder, where));
  if (files.empty())
    throw InputError(fmt::format("{}: no file matches '{}' in {}", where, pattern, folder.string()));
  return found_[pattern] = {files.begin(), files.end()};
}

Json PatternFiles::json() const {
  Json all = Json::object();
  for (const auto& [pattern, files] : found_) {
    Json names = Json::array();
    for (const std::string& file : files)
      if (line_of(Json(file))) names.push_back(file);
    all[pattern] = std::move(names);
  }
  return all;
}

std::vector<SweepInput> read_inputs(const SweptCommand& command, const Json& json, const fs::path& folder,
                                    PatternFiles& files, const std::string& where) {
  if (json.items() == nullptr) return inputs_from(command, json, folder, files, where);
  std::vector<SweepInput> inputs;
  for (std::size_t k = 0; k < json.items()->size(); ++k)
    for (SweepInput& input :
         inputs_from(command, (*json.items())[k], folder, files, fmt::format("{}[{}]", where, k)))
      inputs.push_back(std::move(input));
  return inputs;
}

}  // namespace kds
