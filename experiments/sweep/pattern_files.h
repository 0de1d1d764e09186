#pragma once
// The files that paths and patterns of sweep.json stand for.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/input_hashes.h"

namespace kds {

/// Returns a path in `folder` without `..`. An absolute path stays as it is.
[[nodiscard]] std::filesystem::path in_folder(const std::filesystem::path& folder, const std::string& path);

/// Lists the files of patterns. A sweep's folder remembers them, so that results of files that have been
/// removed since can be collected.
class PatternFiles {
 public:
  PatternFiles() = default;
  /// `hashes` knows the files of earlier starts and must outlive this object. `remembered` is the JSON of an
  /// earlier object. Files of that object are listed too, even if they are gone.
  explicit PatternFiles(const InputHashes& hashes, const Json& remembered = {});

  /// Returns absolute paths in the order of their bytes. A path without *, ? and [, or of a file that exists,
  /// is no pattern. Throws InputError if a pattern matches no file.
  [[nodiscard]] std::vector<std::string> of(const std::string& pattern, const std::filesystem::path& folder,
                                            const std::string& where);
  /// Returns whether a path is a file, or was one at an earlier start. This tells a file whose name has a
  /// comma from a list of files.
  [[nodiscard]] bool is_file(const std::string& path) const;
  /// Returns the files of each pattern, apart from names that are not UTF-8.
  [[nodiscard]] Json json() const;

 private:
  const InputHashes* hashes_ = nullptr;
  std::map<std::string, std::vector<std::string>> remembered_, found_;
};

}  // namespace kds
