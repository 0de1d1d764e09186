#pragma once
// The inputs of a sweep: files, patterns of files, and options that hold for one input only.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/pattern_files.h"
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

/// Reads an input or an array of inputs. Relative paths are relative to `folder`. Throws InputError, which
/// begins with `where`.
[[nodiscard]] std::vector<SweepInput> read_inputs(const SweptCommand& command, const Json& json,
                                                  const std::filesystem::path& folder, PatternFiles& files,
                                                  const std::string& where);

}  // namespace kds
