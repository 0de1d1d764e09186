#include "experiments/sweep/pattern_files.h"

#include <fmt/format.h>
#include <glob.h>

#include <memory>
#include <set>
#include <string_view>

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

}  // namespace

fs::path in_folder(const fs::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();  // an absolute path replaces the folder
}

PatternFiles::PatternFiles(const InputHashes& hashes, const Json& remembered) : hashes_(&hashes) {
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
  else if (files != std::set{whole.string()})  // otherwise the pattern is the name of a file that is gone
    files.merge(matching_files(pattern, folder, where));
  if (files.empty())
    throw InputError(fmt::format("{}: no file matches '{}' in {}", where, pattern, folder.string()));
  return found_[pattern] = {files.begin(), files.end()};
}

bool PatternFiles::is_file(const std::string& path) const {
  std::error_code none;
  return fs::exists(path, none) || (hashes_ != nullptr && hashes_->remembers(path));
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

}  // namespace kds
