#pragma once
// Finds collisions by testing all pairs of beads. This method is the simple reference for the other
// detectors. Tests eight beads at a time in double, and exactly if doubles do not decide. Takes n^2 time.
// With groups of beads it tests the pairs between them one by one.

#include <optional>
#include <vector>

#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Returns all pairs asked for whose closed balls are at most `distance` apart, ascending. At distance 0
/// these are the pairs with a common point.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> pairs_by_force(const Balls<Dimension>& balls, const PairsAsked& asked,
                                                   double distance = 0);

/// Returns the closest of the pairs asked for, or none if no pairs are asked for. If several are equally
/// close, returns the first.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> closest_pair_by_force(const Balls<Dimension>& balls,
                                                               const PairsAsked& asked);

}  // namespace kds
