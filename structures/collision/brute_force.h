#pragma once
// Collision by looking at all pairs of beads: the obvious twin of the other detectors. Eight beads at a time
// in double, exactly where that does not tell. Time n^2.

#include <vector>

#include "structures/collision/closest_so_far.h"
#include "structures/collision/pairs_asked.h"
#include "structures/necklace/balls.h"

namespace kds {

/// All pairs asked for whose closed balls are at most so far apart, ascending. At a distance of 0: those that
/// have a point in common.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> pairs_by_force(const Balls<Dimension>& balls, const PairsAsked& asked,
                                                   double distance = 0);

/// The first of them, if there are any.
template <int Dimension>
[[nodiscard]] std::optional<BeadPair> first_pair_by_force(const Balls<Dimension>& balls,
                                                          const PairsAsked& asked, double distance = 0);

/// The closest of the pairs asked for, of several equally close the first; none if none are asked for.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> closest_pair_by_force(const Balls<Dimension>& balls,
                                                               const PairsAsked& asked);

}  // namespace kds
