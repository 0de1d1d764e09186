#pragma once
// The file sweep.json: inputs, commands and the values of their options. docs/formats.md describes its keys.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/input_files.h"
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

/// A command with its inputs and axes. Tasks are all combinations.
struct SweepBlock {
  const SweptCommand* command = nullptr;
  std::vector<SweepInput> inputs;
  std::vector<Axis> axes;
};

/// Tasks to leave out: those for which each axis has a text that matches its pattern. `input` and `command`
/// are names too.
using Exclusion = std::vector<std::pair<std::string, std::string>>;

struct SweepSpec {
  std::vector<SweepBlock> blocks;
  std::vector<Exclusion> exclusions;
  std::vector<std::string> pooled;  ///< axes over which collected figures are pooled
};

/// Reads a sweep. Relative paths are relative to `folder`. `files` lists the files of patterns. `subject`
/// begins the messages. Throws InputError that names the key, what was expected and the nearest known name.
[[nodiscard]] SweepSpec read_sweep(const Json& json, const std::filesystem::path& folder, InputFiles& files,
                                   const std::string& subject);

/// Returns whether a text matches a pattern with * and ?.
[[nodiscard]] bool matches(std::string_view text, std::string_view pattern);

}  // namespace kds
