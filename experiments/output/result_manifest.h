#pragma once
// Records the files that kds wrote into a directory of results, with their sizes and checksums. A later
// result of the same command replaces or removes only these files. Files that were made or changed by others
// stay.
//
// The manifest is a hidden text file in the directory, .kds-COMMAND-OPTION.files. The manifest has a heading
// and a line for each file with checksum (16 hex digits), size and name.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace kds {

class ResultManifest {
 public:
  /// Reads the manifest of the results that `command` (such as run) writes for `option` (such as --dump), if
  /// it exists. Throws InputError if a file with the manifest's name is not a manifest.
  ResultManifest(std::filesystem::path directory, std::string_view command, std::string_view option);

  /// Throws InputError if the directory has a file with this name that this command did not write, or that
  /// has changed since.
  void require_own(const std::string& name) const;
  /// Returns whether a file with this name exists unchanged since this command wrote it.
  [[nodiscard]] bool is_own(const std::string& name) const;

  [[nodiscard]] bool empty() const { return files_.empty(); }
  /// The files in the manifest. A name appears twice if a program was killed while it replaced the file.
  [[nodiscard]] const auto& files() const { return files_; }
  [[nodiscard]] std::filesystem::path path() const { return directory_ / (".kds-" + key_ + ".files"); }
  [[nodiscard]] std::string heading() const;
  /// Returns the manifest line for the file at `path`, which will get the name `name`.
  [[nodiscard]] static std::string line(const std::filesystem::path& path, std::string_view name);
  /// Returns the lines of all files in the manifest.
  [[nodiscard]] std::string lines() const;

 private:
  struct Content {
    std::uint64_t checksum = 0, size = 0;
    friend bool operator==(const Content&, const Content&) = default;
  };
  static Content content_of(const std::filesystem::path& path);
  static std::string line(const Content& content, std::string_view name);
  /// Returns the command and option whose manifest lists the file in its present state, as in "kds run
  /// --out". Returns "" if no manifest does.
  [[nodiscard]] std::string author_of(const std::string& name) const;

  std::filesystem::path directory_;
  std::string key_, option_, writer_;
  std::multimap<std::string, Content, std::less<>> files_;
};

}  // namespace kds
