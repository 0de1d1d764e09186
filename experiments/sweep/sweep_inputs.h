#pragma once
// The inputs of a sweep: files, patterns of files, and options that hold for one input only.

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/sweep_axis.h"
#include "experiments/sweep/swept_command.h"

namespace kds {

/// The input of a task: usually one file.
struct SweepInput {
  std::string name;                ///< for tables: the path as sweep.json gives it, or the file a glob found,
                                   ///< and its options if several inputs are the same file
  std::vector<std::string> files;  ///< absolute paths
  std::vector<std::pair<std::string, AxisValue>> options;  ///< that hold for this input only
};

/// Lists the files of patterns. A sweep's folder remembers them, so that results of files that have been
/// removed since can be collected.
class PatternFiles {
 public:
  PatternFiles() = default;
  /// `remembered` is the JSON of an earlier object. Files of that object are listed too, even if they are
  /// gone.
  explicit PatternFiles(const Json& remembered);

  /// Returns absolute paths in the order of their bytes. A path without *, ? and [, or of a file that exists,
  /// is no pattern. Throws InputError if a pattern matches no file.
  [[nodiscard]] std::vector<std::string> of(const std::string& pattern, const std::filesystem::path& folder,
                                            const std::string& where);
  /// Returns the files of each pattern, apart from names that are not UTF-8.
  [[nodiscard]] Json json() const;

 private:
  std::map<std::string, std::vector<std::string>> remembered_, found_;
};

/// Reads an input or an array of inputs. Relative paths are relative to `folder`. Throws InputError, which
/// begins with `where`.
[[nodiscard]] std::vector<SweepInput> read_inputs(const SweptCommand& command, const Json& json,
                                                  const std::filesystem::path& folder, PatternFiles& files,
                                                  const std::string& where);

}  // namespace kds
