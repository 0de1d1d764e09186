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

/// Closed balls: touching is meeting. Exact. `reach`: the sum of their radii as a double.
template <int Dimension>
[[nodiscard]] inline bool balls_meet(const Balls<Dimension>& balls, BeadId a, BeadId b, double reach) {
  double square = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const double d = balls.coordinates(axis)[a] - balls.coordinates(axis)[b];
    square += d * d;
  }
  // Each errs by less than 2^-50 of itself. What underflows is below 2^-1000, and where one is tiny or not
  // finite nothing is said.
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

/// The same for many pairs: of equal balls no radius is read again.
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
