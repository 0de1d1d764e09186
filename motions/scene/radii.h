#pragma once
// Bead radii of a run, by the policies of `--radius`.

#include <span>
#include <string>
#include <vector>

#include "motions/readers/trajectory.h"

namespace kds {

/// One radius a bead for all necklaces of a run, in scene order. `policy` is
///   auto          half the longest bond over all frames, chain breaks left out, rounded up so that its beads
///   meet; one radius for all beads of the run; a number      that radius for all (finite, positive); element
///   van der Waals radii; element:fit   the same scaled by one factor until nonadjacent beads are disjoint in
///   the first frame; file:PATH     one a line in bead order, or a single one for all (finite, not negative).
/// Throws InputError naming the option, file, line or bead.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy,
                                             std::span<const Trajectory> necklaces);

}  // namespace kds
