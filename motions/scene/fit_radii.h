#pragma once
// Radii scaled down until nonadjacent beads are disjoint.

#include <span>
#include <vector>

#include "motions/frames/trajectory.h"

namespace kds {

/// The radii (in scene order) times one factor, at most 1, such that in the first frames no two beads touch
/// other than neighbours of one necklace. Throws InputError if two such beads share their centre.
[[nodiscard]] std::vector<double> fit_radii(std::vector<double> radii, std::span<const Trajectory> necklaces);

}  // namespace kds
