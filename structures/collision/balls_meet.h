#pragma once
// Whether two balls meet, in a line of the loops over candidates; and found pairs in order.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "structures/collision/pairs_asked.h"
#include "structures/collision/separation.h"
#include "structures/necklace/ball_distance.h"
#include "structures/necklace/balls.h"

namespace kds {

namespace detail {

/// Not in line: rationals where doubles do not tell.
template <int Dimension>
[[nodiscard]] bool balls_meet_exactly(const Balls<Dimension>& balls, BeadId a, BeadId b);

}  // namespace detail

/// Closed balls: touching is meeting. Exact.
template <int Dimension>
[[nodiscard]] inline bool balls_meet(const Balls<Dimension>& balls, BeadId a, BeadId b) {
  double square = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const double d = balls.coordinates(axis)[a] - balls.coordinates(axis)[b];
    square += d * d;
  }
  const double reach = balls.radii()[a] + balls.radii()[b];
  // Each errs by less than 2^-50 of itself. What underflows is below 2^-1000, and where one is tiny or not
  // finite nothing is said.
  const double limit = reach * reach;
  if (limit >= 0x1p-900 && limit <= 0x1p1000) {
    if (square > limit * (1 + 0x1p-48)) return false;
    if (square * (1 + 0x1p-48) < limit) return true;
  }
  return detail::balls_meet_exactly(balls, a, b);
}

/// At most so far apart (finite, not negative). Exact.
template <int Dimension>
[[nodiscard]] bool balls_within(const Balls<Dimension>& balls, BeadId a, BeadId b, double distance) {
  return within<Dimension>(detail::center_of(balls, a), detail::center_of(balls, b), balls.radius(a),
                           balls.radius(b), distance);
}

/// By first bead, then by second. No pair twice.
class PairSorter {
 public:
  void sort(std::vector<BeadPair>& pairs, std::size_t beads);

 private:
  std::vector<std::size_t> places_;
  std::vector<BeadPair> sorted_;
};

}  // namespace kds
