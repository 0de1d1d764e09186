#pragma once
// The options of all commands that read trajectories: which files, which of their beads and frames, which
// radii.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/command_line.h"
#include "motions/readers/read_trajectory.h"

namespace kds {

struct InputOptions {
  std::vector<std::filesystem::path> inputs;
  ReadOptions reading;  ///< --topology, --select, --chain (as given, of all inputs), --frames
  std::string radius = "auto";
  std::optional<std::filesystem::path> obstacle = {};  ///< --obstacle, of commands that have it
};

inline constexpr std::array kInputOptions{
    OptionSpec{"--topology", "FILE",
               "PDB or mmCIF that names the atoms of a DCD (default: its atoms are the beads)"},
    OptionSpec{"--select", "NAME",
               "backbone (N, CA, C), ca or all (default: backbone where residues are known)"},
    OptionSpec{"--chain", "IDS",
               "the chain to read, or several, a necklace each: A,B; for each INPUT its own: A,B/C; a "
               "molecule by its number: A.2 of chain A, 2 of those without a chain "
               "(default: the first polymer chain)"},
    OptionSpec{"--frames", "RANGE", "FIRST:LAST:STRIDE, from 0, LAST excluded (default: all)"},
    OptionSpec{"--radius", "RULE", "auto, a number, element, element:fit or file:PATH (default: auto)"},
};
/// The option of commands that put all inputs on one clock.
inline constexpr std::array kObstacleOption{
    OptionSpec{"--obstacle", "FILE",
               "a necklace of one frame, which rests while the others move; its chain behind a / of --chain: "
               "A,B/C (default: none)"},
};
inline constexpr std::string_view kInputOperand = "INPUT...";
/// The formats of trajectories, in the help of commands.
inline constexpr std::string_view kTrajectoryHelp =
    "a necklace: .pdb .ent .cif .mmcif .dcd .xyz .extxyz (also .gz)";
inline constexpr std::string_view kInputHelp =
    "a necklace: .pdb .ent .cif .mmcif .dcd .xyz .extxyz (also .gz), or an instance file";

/// `command` as in kds run. Throws InputError naming the option; opens no file.
[[nodiscard]] InputOptions parse_input_options(const ParsedArguments& parsed, std::string_view command);

/// How the input of this number is to be read: with its own chains. The obstacle comes after the inputs.
[[nodiscard]] ReadOptions reading_of(const InputOptions& options, std::size_t input);

/// Throws InputError where there is no regular file: pipes and devices need not end.
void check_exists(const std::filesystem::path& path);

/// Throws likewise for the inputs, the topology and the obstacle.
void check_inputs_exist(const InputOptions& options);

}  // namespace kds
