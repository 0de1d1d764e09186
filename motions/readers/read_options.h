#pragma once
// Options that select which atoms and frames of a file are read.

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/frames/frame_selection.h"
#include "motions/frames/periodic.h"
#include "motions/readers/selection.h"

namespace kds {

/// The unit styles of LAMMPS that are read. The unit style gives the units of lengths and times.
enum class LammpsUnits {
  real,   ///< angstrom, femtoseconds
  metal,  ///< angstrom, picoseconds
  lj,     ///< reduced units, read as they are, without times
  nano,   ///< nanometres, nanoseconds
};
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 4> lammps_units_names{"real", "metal", "lj", "nano"};
[[nodiscard]] constexpr std::string_view name_of(LammpsUnits units) {
  return lammps_units_names[static_cast<std::size_t>(units)];
}

/// How beads move through the walls of a periodic cell, from frame to frame.
enum class Unwrap {
  none,    ///< not at all: positions are those of the file
  chains,  ///< molecules are made whole along their bonds, and move as a whole
  beads,   ///< each bead moves to the image nearest to where it was
};
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> unwrap_names{"none", "chains", "beads"};
[[nodiscard]] constexpr std::string_view name_of(Unwrap unwrap) {
  return unwrap_names[static_cast<std::size_t>(unwrap)];
}

struct ReadOptions {
  std::optional<std::filesystem::path> topology = {};  ///< file that names the atoms of a trajectory
  Selection selection = Selection::automatic;
  std::optional<std::string> chain = {};  ///< comma-separated; none: the first polymer chain
  FrameRange frames = {};
  std::optional<std::string> format = {};  ///< name of a reader; none: found from the file
  std::optional<double> time_step = {};    ///< picoseconds between frames; none: times as in the file
  bool until_damage = false;               ///< reads the frames before a damaged one
  std::optional<LammpsUnits> units = {};   ///< for LAMMPS dumps; none: as the file says, else angstrom
  /// None: chains; but beads for a file that names no molecules and whose beads are a fluid
  /// (SequenceInCell).
  std::optional<Unwrap> unwrap = {};
  bool velocities = false;             ///< velocities are read, where a format has them
  std::vector<Selection> groups = {};  ///< groups of the selected beads, at most eight (BeadGroups)

  // For running simulations (imd_reader.h); readers of files leave these unread.
  /// The last time that is read, in picoseconds; for frames without times the last frame's number.
  std::optional<double> until = {};
  /// Seconds to wait for the connection, and for each frame; none: 60.
  std::optional<double> patience = {};
  std::optional<Cell> cell = {};       ///< of all frames, for simulations that send no cells
  std::optional<unsigned> rate = {};   ///< asks the simulation to send every rate-th step, from 1
  std::function<void()> on_wait = {};  ///< called once if the simulation does not listen yet
};

}  // namespace kds
