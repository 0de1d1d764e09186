#pragma once
// The options of all commands that read trajectories: which files, which of their beads and frames, which
// radii.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"
#include "motions/readers/read_trajectory.h"

namespace kds {

struct InputOptions {
  std::vector<std::filesystem::path> inputs;
  ReadOptions reading;  ///< --topology, --select, --chain (as given, of all inputs), --frames
  std::string radius = "auto";
  std::optional<std::filesystem::path> obstacle = {};  ///< --obstacle, of commands that have it
};

/// --topology, --select, --chain, --frames, --radius.
[[nodiscard]] const OptionList<InputOptions>& input_options();
/// --obstacle, of commands that put all inputs on one clock.
[[nodiscard]] const Option<InputOptions>& obstacle_option();
inline constexpr std::string_view kInputOperand = "INPUT...";
/// The formats of trajectories, in the help of commands.
inline constexpr std::string_view kTrajectoryHelp =
    "a necklace: .pdb .ent .cif .mmcif .dcd .xyz .extxyz (also .gz)";
inline constexpr std::string_view kInputHelp =
    "a necklace: .pdb .ent .cif .mmcif .dcd .xyz .extxyz (also .gz), or an instance file";

/// Takes the inputs from the operands of `command`, such as kds run, when its options are read. Throws
/// InputError if there are none, and if --chain does not fit their number. Opens no file.
void take_inputs(const ParsedArguments& parsed, std::string_view command, InputOptions& options);

/// How the input of this number is to be read: with its own chains. The obstacle comes after the inputs.
[[nodiscard]] ReadOptions reading_of(const InputOptions& options, std::size_t input);

/// FIRST:LAST:STRIDE, as --frames takes it.
[[nodiscard]] std::string name_of(const FrameRange& frames);

/// The inputs' names without their folders, between commas.
[[nodiscard]] std::string file_names(const InputOptions& options);
/// The inputs' paths, and that of the obstacle.
[[nodiscard]] Json files_json(const InputOptions& options);

/// The size of an input, as results tell it.
struct InputSize {
  std::size_t beads = 0;
  std::optional<std::size_t> necklaces = {};  ///< none: not told
  std::size_t frames = 0;
  int dimension = 3;
};
/// Files, size and the least and largest radius of an input.
[[nodiscard]] Json input_json(const InputOptions& options, const InputSize& size, double radius_min,
                              double radius_max);
/// The same for `radii`, of which there is one a bead.
[[nodiscard]] Json input_json(const InputOptions& options, InputSize size, std::span<const double> radii);

/// Throws InputError where there is no regular file: pipes and devices need not end.
void check_exists(const std::filesystem::path& path);

/// Throws likewise for the inputs, the topology and the obstacle.
void check_inputs_exist(const InputOptions& options);

}  // namespace kds
