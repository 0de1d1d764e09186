#pragma once
// The convex hull in the plane of beads that stand still, by Andrew's monotone chain.

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

/// Both halves from the first to the last bead, strictly convex; of coincident beads the least.
struct StaticHull {
  std::vector<BeadId> lower, upper;

  /// Counterclockwise from the first bead.
  [[nodiscard]] std::vector<BeadId> circle() const {
    std::vector<BeadId> all = lower;
    for (std::size_t i = upper.size(); i-- > 2;) all.push_back(upper[i - 1]);
    return all;
  }
};

/// Of beads that ascend at first. `order(a, b)`: along the first axis, then the second, negative where a is
/// before b, zero where they coincide. `turn(a, b, c)`: positive counterclockwise.
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
