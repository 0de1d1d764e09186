#pragma once
// Writes a necklace as the readers read it.

#include <iosfwd>
#include <string_view>

#include "motions/frames/trajectory.h"

namespace kds {

/// XYZ: coordinates read back exactly. Atoms of no element (X); `about` is each frame's comment, without
/// line ends.
void write_xyz(std::ostream& stream, const Trajectory& trajectory, std::string_view about);

/// PDB: one model a frame, one residue (UNK) a bead, its atom CA. Coordinates have three decimals.
void write_pdb(std::ostream& stream, const Trajectory& trajectory, std::string_view about);

/// What the reader makes of write_pdb's coordinates: the doubles nearest to them in thousandths. Throws
/// InputError where the columns of PDB do not hold them, or the numbers of beads and frames; it names the
/// `file` and the bead.
[[nodiscard]] Trajectory as_in_pdb(const Trajectory& trajectory, std::string_view file);

}  // namespace kds
