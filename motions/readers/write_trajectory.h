#pragma once
// Writes a necklace in formats that the readers read.

#include <iosfwd>
#include <string_view>

#include "motions/frames/trajectory.h"

namespace kds {

/// Writes XYZ. Coordinates read back exactly. Atoms have no element (X). `about` is the comment of each frame
/// and must not contain line ends.
void write_xyz(std::ostream& stream, const Trajectory& trajectory, std::string_view about);

/// Writes PDB, with one model per frame and one residue (UNK) with one atom (CA) per bead. Coordinates have
/// three decimals.
void write_pdb(std::ostream& stream, const Trajectory& trajectory, std::string_view about);

/// Returns the trajectory that the reader obtains from write_pdb's output: each coordinate is the double
/// nearest to its value in thousandths. Throws InputError naming the `file` and the bead if the columns of
/// PDB cannot hold a coordinate, or the number of beads or frames.
[[nodiscard]] Trajectory as_in_pdb(const Trajectory& trajectory, std::string_view file);

}  // namespace kds
