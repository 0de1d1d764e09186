#pragma once
// The options that all trajectory-reading commands share: input files, selected beads, selected frames and
// radii. Also the option for the project's data folder, from which some commands take their inputs.

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"
#include "motions/base/input_error.h"
#include "motions/frames/frame_stamp.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/scene.h"

namespace kds {

/// Returns the folder `data` of the source tree from which the program was built.
[[nodiscard]] std::filesystem::path source_data_folder();

struct InputOptions {
  std::vector<std::filesystem::path> inputs;
  /// --topology, if it lists a file for each input; an empty path is none. Empty if it has a single file,
  /// which is in `reading` and serves all inputs.
  std::vector<std::filesystem::path> topologies = {};
  ReadOptions reading;  ///< --topology, --select, --chain (as given, for all inputs), --frames; --groups
  std::string radius = "auto";
  std::optional<VelocitySource> velocities = {};  ///< --velocities; none: the file if they help (FrameSurvey)
  bool periodic = true;  ///< images of beads count where all frames have a cell; false: --no-periodic
  std::optional<std::filesystem::path> obstacle = {};  ///< --obstacle, for the commands that have it
  std::string cell = {};                               ///< --cell, as given
  bool takes_live = false;  ///< the command can follow a running simulation; others refuse such an input
};

/// Returns the options --topology, --select, --chain, --frames and --radius.
[[nodiscard]] const OptionList<InputOptions>& input_options();
/// Returns the text of `kds help inputs`.
[[nodiscard]] std::string inputs_help();
/// Returns the option --obstacle, for commands that put all inputs on one clock.
[[nodiscard]] const Option<InputOptions>& obstacle_option();
/// Returns the option --velocities, for commands whose beads may move on Hermite curves.
[[nodiscard]] const Option<InputOptions>& velocities_option();
/// Returns the options --until, --cell, --rate and --patience, for commands that can follow a running
/// simulation.
[[nodiscard]] const OptionList<InputOptions>& live_options();
/// Returns the option --groups, for commands that look at pairs of beads. `help` must outlive the option.
[[nodiscard]] Option<InputOptions> groups_option(
    const std::string& help =
        fmt::format("contacts: one bead of a pair must be in SEL1 and the other in SEL2, each as {} takes "
                    "it, among the beads that are read (default: all pairs)",
                    "--select"_arg));
inline constexpr std::string_view kInputOperand = "INPUT...";
/// Adds the operand INPUT... to a command. Its help lists the formats of the reader registry, and instance
/// files and running simulations if the command takes them.
[[nodiscard]] CommandSpec with_inputs(CommandSpec command, bool or_instance = false, bool or_live = false);

/// Takes the inputs from the operands of `command` (such as `kds run`) after its options have been read.
/// Throws InputError if there are no inputs, or if the number of --chain lists does not fit the number of
/// inputs. Topologies are checked in the same way. Opens no file.
void take_inputs(const ParsedArguments& parsed, std::string_view command, InputOptions& options);

/// Throws InputError if --topology or --chain list more or fewer items than there are inputs.
void check_input_lists(const InputOptions& options);

/// Returns the reading options of input number `input`, with the chains and the topology of that input. The
/// obstacle has the number after the last input.
[[nodiscard]] ReadOptions reading_of(const InputOptions& options, std::size_t input);

/// Returns FIRST:LAST:STRIDE, as --frames takes it.
[[nodiscard]] std::string name_of(const FrameRange& frames);

/// Returns the path of an input as it was given, or the label of frames in memory.
[[nodiscard]] std::string input_name(const InputOptions& options, std::size_t input);
/// Returns the file names of the inputs without their folders, separated by commas.
[[nodiscard]] std::string file_names(const InputOptions& options);
/// Returns whether the formats of all inputs give lengths in angstrom. Instances, XYZ files and LAMMPS dumps
/// in units `lj` name no unit. Opens the inputs.
[[nodiscard]] bool in_angstrom(const InputOptions& options);

/// Returns "angstrom", or an empty text if lengths have no unit.
[[nodiscard]] inline std::string length_unit(const InputOptions& options) {
  return in_angstrom(options) ? "angstrom" : "";
}

/// Returns the paths of the inputs and of the obstacle.
[[nodiscard]] Json files_json(const InputOptions& options);

/// The size of an input as results show it.
struct InputSize {
  std::size_t beads = 0;
  std::optional<std::size_t> necklaces = {};  ///< empty if the result does not show it
  std::size_t frames = 0;
  int dimension = 3;
  bool truncated = false;  ///< frames are missing at the end (FrameSource::is_truncated)
  std::optional<VelocitySource> velocities = {};  ///< of Hermite motion (Scene::velocities)
  std::array<FrameStamp, 2> ends = {};            ///< of the first and the last frame
};
[[nodiscard]] InputSize size_of(const Scene& scene);
/// Returns ", velocities of the file" or the like, or an empty text.
[[nodiscard]] std::string_view velocities_text(const std::optional<VelocitySource>& velocities);
/// Adds `first_frame` and `last_frame`, the numbers of both frames in the file, and `picoseconds` if both
/// frames have times.
void add_ends(Json& input, const std::array<FrameStamp, 2>& ends);
/// Returns the files, the size, and the least and largest radius of an input.
[[nodiscard]] Json input_json(const InputOptions& options, const InputSize& size, double radius_min,
                              double radius_max);
/// Overload that takes the least and largest radius from `radii`, which has one entry per bead.
[[nodiscard]] Json input_json(const InputOptions& options, InputSize size, std::span<const double> radii);

/// Throws InputError unless `path` is a regular file. Pipes and devices are refused because they may never
/// end.
void check_exists(const std::filesystem::path& path);

/// Throws InputError unless the inputs, the topology and the obstacle are regular files. Inputs may also be
/// addresses of running simulations.
void check_inputs_exist(const InputOptions& options);
/// Returns whether an input is the address of a running simulation.
[[nodiscard]] bool is_live(const InputOptions& options);

}  // namespace kds
