#include "experiments/sweep/input_files.h"

#include <glob.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <string_view>

#include "experiments/output/text.h"
#include "experiments/sweep/refuse.h"
#include "experiments/sweep/task_name.h"
#include "motions/base/input_file.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kWildcards = "*?[";

// Returns 0 if the file cannot be read.
std::uint64_t hash_of_content(const std::string& file, const std::function<bool()>& stopped) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return 0;
  TextHash hash;
  std::vector<char> block(std::size_t{1} << 20U);
  std::uint64_t size = 0;
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    const auto bytes = static_cast<std::size_t>(stream.gcount());
    std::size_t at = 0;
    for (std::uint32_t word = 0; at + sizeof word <= bytes; at += sizeof word) {
      std::memcpy(&word, block.data() + at, sizeof word);
      hash.add_word(word);
    }
    hash.add(std::string_view(block.data() + at, bytes - at));
    size += bytes;
    if (stopped()) throw SweepStopped{};
  }
  if (stream.bad()) return 0;
  hash.add(std::to_string(size));
  return std::max<std::uint64_t>(hash.value(), 1);
}

std::string text_in(const Json& object, std::string_view name) {
  const Json* const found = object.find(name);
  return found != nullptr && found->text() != nullptr ? *found->text() : std::string();
}

std::set<std::string> matching_files(const std::string& pattern, const fs::path& folder,
                                     const std::string& where) {
  if (pattern.find("**") != std::string::npos)
    refuse("{}: '{}': ** is not supported; expected one pattern for each depth of folders", where, pattern);
  std::string quoted;  // the folder matches itself only
  for (const char c : folder.string()) {
    if (c == '\\' || kWildcards.find(c) != std::string_view::npos) quoted += '\\';
    quoted += c;
  }
  glob_t found{};
  const int failed = ::glob(in_folder(quoted, pattern).c_str(), 0, nullptr, &found);
  const std::unique_ptr<glob_t, decltype(&::globfree)> owner(&found, &::globfree);
  if (failed == GLOB_NOMATCH) return {};
  if (failed != 0) refuse("{}: cannot list the files of '{}'", where, pattern);
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

}  // namespace

fs::path in_folder(const fs::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();  // an absolute path replaces the folder
}

InputFiles::InputFiles(const Json& kept, Patterns patterns, std::function<bool()> stopped)
    : stopped_(std::move(stopped)) {
  const Json *const files = kept.find("files"), *const found = kept.find("patterns");
  if (files != nullptr && files->members() != nullptr)
    for (const auto& [path, item] : *files->members()) {
      File& file = earlier_[path];
      file.hash = std::strtoull(text_in(item, "hash").c_str(), nullptr, 16);
      file.stamp = text_in(item, "stamp");
      file.settled = !file.stamp.empty();
    }
  if (patterns == Patterns::now || found == nullptr || found->members() == nullptr) return;
  for (const auto& [pattern, names] : *found->members())
    for (const Json& name : names.items() != nullptr ? *names.items() : Json::Items{})
      if (name.text() != nullptr) earlier_patterns_[pattern].insert(*name.text());
}

std::vector<std::string> InputFiles::matching(const std::string& pattern, const fs::path& folder,
                                              const std::string& where) {
  refuse_standard_input(pattern);
  const fs::path whole = in_folder(folder, pattern);
  if (pattern.find_first_of(kWildcards) == std::string::npos) return {whole.string()};
  std::error_code none;
  std::set<std::string>& files = patterns_[pattern] = earlier_patterns_[pattern];
  if (fs::exists(whole, none))
    files.insert(whole.string());
  else if (files != std::set{whole.string()})  // otherwise the pattern is the name of a file that is gone
    files.merge(matching_files(pattern, folder, where));
  if (files.empty()) refuse("{}: no file matches '{}' in {}", where, pattern, folder.string());
  return {files.begin(), files.end()};
}

InputFiles::File InputFiles::seen(const std::string& path) {
  File file;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return file;
  file.stamp = fmt::format("{} {} {}.{:09} {}.{:09}", status.st_size, status.st_ino, status.st_mtim.tv_sec,
                           status.st_mtim.tv_nsec, status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
  constexpr std::time_t settled = 2;  // whole seconds, so at least one has passed
  file.settled = std::time(nullptr) - status.st_ctim.tv_sec >= settled;
  return file;
}

// A file is looked at before it is read, so a change meanwhile gives it another time than the one noted.
std::uint64_t InputFiles::hash(const std::string& path) {
  if (const auto known = files_.find(path); known != files_.end()) return known->second.hash;
  File file = seen(path);
  const auto earlier = earlier_.find(path);
  const bool remembered = earlier != earlier_.end();
  const bool same = remembered && !file.stamp.empty() && earlier->second.stamp == file.stamp;
  if (!file.stamp.empty()) file.hash = same ? earlier->second.hash : hash_of_content(path, stopped_);
  if (file.hash == 0 && remembered) {
    file = {earlier->second.hash, "", false};
    gone_.insert(path);
  }
  return files_.emplace(path, file).first->second.hash;
}

bool InputFiles::has_changed(const std::string& path) {
  const auto known = files_.find(path);
  if (known == files_.end()) return false;
  File& then = known->second;
  File now = seen(path);
  if (now.stamp == then.stamp) return false;
  if (now.stamp.empty() || then.stamp.empty()) return true;
  try {
    now.hash = hash_of_content(path, stopped_);
  } catch (const SweepStopped&) {
    return true;  // the answer no longer matters: the sweep ends
  }
  if (now.hash == then.hash) then = now;
  return now.hash != then.hash;
}

Json InputFiles::json() const {
  const auto in_json = [](const std::string& name) { return line_of(Json(name)).has_value(); };  // UTF-8
  auto known = files_;
  known.insert(earlier_.begin(), earlier_.end());
  Json files = Json::object(), patterns = Json::object();
  for (const auto& [path, file] : known) {
    if (file.hash == 0 || !in_json(path)) continue;
    files[path] = {{"hash", hex_digits(file.hash)}};
    if (file.settled) files[path]["stamp"] = file.stamp;
  }
  for (const auto& [pattern, found] : patterns_) {
    Json names = Json::array();
    for (const std::string& name : found)
      if (in_json(name)) names.push_back(name);
    patterns[pattern] = std::move(names);
  }
  return {{"patterns", patterns}, {"files", files}};
}

}  // namespace kds
