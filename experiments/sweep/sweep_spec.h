#pragma once
// The file sweep.json: inputs, commands and the values of their options. docs/formats.md describes its keys.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/sweep_axis.h"
#include "experiments/sweep/sweep_inputs.h"
#include "experiments/sweep/swept_command.h"

namespace kds {

/// A command with its inputs and axes. Tasks are all combinations.
struct SweepBlock {
  const SweptCommand* command = nullptr;
  std::vector<SweepInput> inputs;
  std::vector<Axis> axes;
  std::optional<std::size_t> segment_steps;  ///< longest segment of a trajectory, in steps
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
[[nodiscard]] SweepSpec read_sweep(const Json& json, const std::filesystem::path& folder, PatternFiles& files,
                                   const std::string& subject);

/// Returns whether a text matches a pattern with * and ?.
[[nodiscard]] bool matches(std::string_view text, std::string_view pattern);

}  // namespace kds
