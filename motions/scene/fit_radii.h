#pragma once
// Scales radii down until nonadjacent beads are disjoint.

#include <span>
#include <vector>

#include "motions/frames/trajectory.h"

namespace kds {

/// Returns the radii (in scene order) times one factor, at most 1, such that in the first frames no two beads
/// touch except neighbours of one necklace. Throws InputError if two such beads have the same centre.
[[nodiscard]] std::vector<double> fit_radii(std::vector<double> radii, std::span<const Trajectory> necklaces);

}  // namespace kds
