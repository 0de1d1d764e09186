#pragma once
// The convex hull in the plane of beads at fixed positions, by Andrew's monotone chain.

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

/// Both halves from the first to the last bead, strictly convex. If beads coincide, only the least is used.
struct StaticHull {
  std::vector<BeadId> lower, upper;

  /// Returns the corners counterclockwise from the first bead.
  [[nodiscard]] std::vector<BeadId> circle() const {
    std::vector<BeadId> all = lower;
    for (std::size_t i = upper.size(); i-- > 2;) all.push_back(upper[i - 1]);
    return all;
  }
};

/// Computes the hull of `sorted`, which must list the beads in ascending order of their ids. `order(a, b)`
/// compares along the first axis, then along the second: negative if a is before b, zero if they coincide.
/// `turn(a, b, c)` is positive if the beads turn counterclockwise.
template <std::invocable<BeadId, BeadId> Order, std::invocable<BeadId, BeadId, BeadId> Turn>
[[nodiscard]] StaticHull static_hull(std::vector<BeadId> sorted, Order order, Turn turn) {
  std::stable_sort(sorted.begin(), sorted.end(), [&](BeadId a, BeadId b) { return order(a, b) < 0; });
  sorted.erase(
      std::unique(sorted.begin(), sorted.end(), [&](BeadId a, BeadId b) { return order(a, b) == 0; }),
      sorted.end());
  const auto half = [&](int side) {
    std::vector<BeadId> chain;
    for (const BeadId bead : sorted) {
      while (chain.size() > 1 && side * turn(chain.end()[-2], chain.back(), bead) <= 0) chain.pop_back();
      chain.push_back(bead);
    }
    return chain;
  };
  return {half(1), half(-1)};
}

}  // namespace kds
