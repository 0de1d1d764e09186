#pragma once
// The file sweep.json: inputs, commands and the values of their options. docs/formats.md describes its keys.

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"

namespace kds {

/// A command as its help describes it.
struct SweptCommand {
  struct Option {
    std::string name;   ///< without its dashes
    std::string value;  ///< placeholder of the value in the help; empty for a flag
    std::size_t count = 1;
  };
  std::string name;
  bool takes_inputs = false, needs_inputs = false;
  std::vector<Option> options;

  [[nodiscard]] const Option* find(std::string_view option) const;
};

/// Returns a command by its name, as its own help describes it. Throws InputError if there is no such command
/// or if its results cannot be swept.
[[nodiscard]] const SweptCommand& swept_command(const std::string& name, const std::string& subject);
/// Returns the names of all commands that can be swept.
[[nodiscard]] const std::vector<std::string>& swept_commands();

/// The setting of one option: the words that follow the option on the command line. A flag has no words.
struct AxisValue {
  std::vector<std::string> words;
  bool given = true;  ///< false if the option is left out
  std::string text;   ///< for tables
};

/// An option and the values that it takes in turn. `stride` is an axis of every command that has --frames.
struct Axis {
  std::string name;
  std::vector<AxisValue> values;
};

inline constexpr std::string_view stride_axis = "stride";

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
  std::optional<std::size_t> part_steps;  ///< longest part of a trajectory, in steps
};

/// Tasks to leave out: those for which each axis has a text that matches its pattern. `input` and `command`
/// are names too.
using Exclusion = std::vector<std::pair<std::string, std::string>>;

struct SweepSpec {
  std::vector<SweepBlock> blocks;
  std::vector<Exclusion> exclusions;
  std::vector<std::string> pooled;  ///< axes over which collected figures are pooled
};

/// Reads a sweep. Relative paths are relative to `folder`. `subject` begins the messages. Throws InputError
/// that names the key, what was expected and the nearest known name.
[[nodiscard]] SweepSpec read_sweep(const Json& json, const std::filesystem::path& folder,
                                   const std::string& subject);

/// Returns whether a text matches a pattern with * and ?.
[[nodiscard]] bool matches(std::string_view text, std::string_view pattern);

/// Returns the files that an option's value names, as absolute paths: those of --topology, --obstacle and
/// `--radius file:PATH`.
[[nodiscard]] std::vector<std::string> files_of_value(const std::string& option, const AxisValue& value);

}  // namespace kds
