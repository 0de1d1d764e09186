#pragma once
// Balls that may meet, found without looking at all pairs: a grid for each power of two among the diameters.
// Time n log n, times the number of such powers, plus the pairs visited. Where coordinates are too large for
// the cells to be told apart in 64 bits, a sweep along the first axis takes the grid's place.

#include <Eigen/Core>
#include <functional>
#include <span>

#include "motions/base/bead.h"

namespace kds {

/// Calls visit(i, j), i < j, once for every pair of closed balls that meets, and for some pairs that are
/// near; in no order to rely on. Centres and radii must be finite, radii not negative.
void visit_near_pairs(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                      const std::function<void(BeadId, BeadId)>& visit);

}  // namespace kds
