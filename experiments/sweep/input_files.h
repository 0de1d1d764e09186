#pragma once
// The input files of a sweep: the files that patterns of sweep.json stand for, and hashes of their content.
// plan.json remembers both. A remembered hash is taken if inode, size, modification time and status change
// time of the file are as they were. Programs cannot set the status change time, so other content of equal
// size and modification time is noticed. A file that is gone keeps the hash that the folder remembers.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"

namespace kds {

/// Thrown if a signal asks the program to end.
struct SweepStopped {};

/// Returns a path in `folder` without `..`. An absolute path stays as it is.
[[nodiscard]] std::filesystem::path in_folder(const std::filesystem::path& folder, const std::string& path);

class InputFiles {
 public:
  enum class Patterns : std::uint8_t { now, now_and_before };
  /// `kept` is the JSON of an earlier object, or null. With Patterns::now_and_before, patterns also stand for
  /// the files that they found then. `stopped` is asked while files are read; if it returns true,
  /// SweepStopped is thrown.
  explicit InputFiles(
      const Json& kept = {}, Patterns patterns = Patterns::now,
      std::function<bool()> stopped = [] { return false; });

  /// Returns the files that a pattern stands for, as absolute paths in the order of their bytes. A path
  /// without *, ? and [, or of a file that exists, is no pattern. Throws InputError if a pattern matches no
  /// file.
  [[nodiscard]] std::vector<std::string> matching(const std::string& pattern,
                                                  const std::filesystem::path& folder,
                                                  const std::string& where);
  /// Returns the hash of a file's content. If the file cannot be read, returns the hash that is remembered,
  /// or 0 if there is none: the task will say why.
  [[nodiscard]] std::uint64_t hash(const std::string& file);
  /// The files that cannot be read and have a remembered hash.
  [[nodiscard]] const std::set<std::string>& gone() const { return gone_; }
  /// Returns whether a file has another content than when its hash was asked for, or has come or gone since.
  /// Reads a file whose inode, size or times differ.
  [[nodiscard]] bool has_changed(const std::string& file);
  /// Returns all files and patterns, apart from names that are not UTF-8.
  [[nodiscard]] Json json() const;

 private:
  struct File {
    std::uint64_t hash = 0;
    std::string stamp;     ///< size, inode and times; empty if the file does not exist
    bool settled = false;  ///< old enough that a later change has another time
  };
  [[nodiscard]] static File seen(const std::string& file);

  std::function<bool()> stopped_;
  std::map<std::string, File> files_, earlier_;
  std::set<std::string> gone_;
  std::map<std::string, std::set<std::string>> patterns_, earlier_patterns_;
};

}  // namespace kds
