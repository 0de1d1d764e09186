#pragma once
// The files that kds wrote into a directory of results, with their sizes and checksums. A later result of the
// same command replaces or removes these files only: a file that somebody else made, or changed since, stays.
//
// The manifest is a hidden text file of the directory, .kds-COMMAND-OPTION.files: a heading, then a line for
// each file with its checksum (16 hex digits), size and name.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace kds {

class ResultManifest {
 public:
  /// The manifest of the results that `command` (run) writes for `option` (--dump). Reads it where there is
  /// one. Throws InputError where a file of that name is no manifest.
  ResultManifest(std::filesystem::path directory, std::string_view command, std::string_view option);

  /// Throws InputError where the directory has a file of this name that this command did not write, or that
  /// has changed since.
  void require_own(const std::string& name) const;
  /// Returns whether the file of this name is there as this command wrote it.
  [[nodiscard]] bool is_own(const std::string& name) const;

  [[nodiscard]] bool empty() const { return files_.empty(); }
  /// A name is listed twice if a program was killed while it replaced the file.
  [[nodiscard]] const auto& files() const { return files_; }
  [[nodiscard]] std::filesystem::path path() const { return directory_ / (".kds-" + key_ + ".files"); }
  [[nodiscard]] std::string heading() const;
  /// The line of a file that lies at `path` and is to have this name.
  [[nodiscard]] static std::string line(const std::filesystem::path& path, std::string_view name);
  /// The lines of all files listed.
  [[nodiscard]] std::string lines() const;

 private:
  struct Content {
    std::uint64_t checksum = 0, size = 0;
    friend bool operator==(const Content&, const Content&) = default;
  };
  static Content content_of(const std::filesystem::path& path);
  static std::string line(const Content& content, std::string_view name);
  void read();
  /// Returns the command and option whose manifest lists the file as it is, as in "kds run --out"; "" if
  /// there is no such manifest.
  [[nodiscard]] std::string author_of(const std::string& name) const;

  std::filesystem::path directory_;
  std::string key_, option_, writer_;
  std::multimap<std::string, Content, std::less<>> files_;
};

}  // namespace kds
