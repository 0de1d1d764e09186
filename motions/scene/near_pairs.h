#pragma once
// Finds balls that may meet without examining all pairs, with one grid for each power of two among the
// diameters (a cell list). Takes time O(n log n) times the number of such powers, plus the number of pairs
// visited. If coordinates are too large to distinguish cells in 64 bits, a sweep along the first axis
// replaces the grid.

#include <Eigen/Core>
#include <functional>
#include <span>

#include "motions/base/bead.h"

namespace kds {

/// Calls visit(i, j), i < j, once for every pair of closed balls that meets, and for some pairs of nearby
/// balls. The order is unspecified. Centres and radii must be finite, radii not negative.
void visit_near_pairs(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                      const std::function<void(BeadId, BeadId)>& visit);

}  // namespace kds
