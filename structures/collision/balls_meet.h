#pragma once
// Tests whether two balls meet, inline in the loops over candidates, and sorts the pairs found.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "structures/collision/pairs_asked.h"
#include "structures/collision/separation.h"
#include "structures/necklace/ball_distance.h"
#include "structures/necklace/balls.h"

namespace kds {

namespace detail {

/// Not inline. Falls back on rationals if doubles do not decide.
template <int Dimension>
[[nodiscard]] bool balls_meet_exactly(const Balls<Dimension>& balls, BeadId a, BeadId b);

}  // namespace detail

/// Returns exactly whether two closed balls meet; touching balls meet. `reach` is the sum of their radii as a
/// double.
template <int Dimension>
[[nodiscard]] inline bool balls_meet(const Balls<Dimension>& balls, BeadId a, BeadId b, double reach) {
  double square = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const double d = balls.coordinates(axis)[a] - balls.coordinates(axis)[b];
    square += d * d;
  }
  // Both sides of the comparison have relative errors below 2^-50. Underflow is below 2^-1000. If a side is
  // tiny or not finite, the exact test decides.
  const double limit = reach * reach;
  if (limit >= 0x1p-900 && limit <= 0x1p1000) {
    if (square > limit * (1 + 0x1p-48)) return false;
    if (square * (1 + 0x1p-48) < limit) return true;
  }
  return detail::balls_meet_exactly(balls, a, b);
}

template <int Dimension>
[[nodiscard]] inline bool balls_meet(const Balls<Dimension>& balls, BeadId a, BeadId b) {
  return balls_meet(balls, a, b, balls.radii()[a] + balls.radii()[b]);
}

/// Tests many pairs with balls_meet. If all radii are equal, they are read once only.
template <int Dimension>
class MeetingBalls {
 public:
  explicit MeetingBalls(const Balls<Dimension>& balls)
      : balls_(balls),
        equal_(balls.equal_radii() && balls.size() > 0),
        reach_(equal_ ? balls.radius(0) + balls.radius(0) : 0) {}
  [[nodiscard]] bool operator()(BeadId a, BeadId b) const {
    return equal_ ? balls_meet(balls_, a, b, reach_) : balls_meet(balls_, a, b);
  }

 private:
  const Balls<Dimension>& balls_;
  bool equal_;
  double reach_;
};

/// Returns exactly whether two balls are at most `distance` apart, where `distance` is finite and not
/// negative.
template <int Dimension>
[[nodiscard]] bool balls_within(const Balls<Dimension>& balls, BeadId a, BeadId b, double distance) {
  return within<Dimension>(detail::center_of(balls, a), detail::center_of(balls, b), balls.radius(a),
                           balls.radius(b), distance);
}

/// Sorts pairs by first bead, then by second. No pair may occur twice.
class PairSorter {
 public:
  void sort(std::vector<BeadPair>& pairs, std::size_t beads);

 private:
  std::vector<std::size_t> places_;
  std::vector<BeadPair> sorted_;
};

}  // namespace kds
