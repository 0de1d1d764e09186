#pragma once
// Decides exactly whether two balls meet, or are within a distance of each other: in double if an error bound
// allows it, else on rationals. Sorts the pairs found.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "structures/enclosing_sphere/sphere_of_points.h"
#include "structures/necklace/ball_distance.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

// In these functions, `square` is a squared distance of centres, and `reach` is the sum of two radii and a
// distance. Neither `square` nor `reach` is negative, and each is rounded as it was computed. The roundings
// are below 2^-49 of each number. Underflow in one number is below 2^-1000, while the other is at least
// 2^-900. Infinity compares as larger than all finite numbers, as the exact number would.

/// Returns true only if the balls are certainly farther apart.
[[nodiscard]] inline bool surely_apart(double square, double reach) {
  return bool(int(square > reach * reach * (1 + 0x1p-46)) & int(square >= 0x1p-900));
}
/// Returns true only if the balls are certainly not farther apart.
[[nodiscard]] inline bool surely_within(double square, double reach) {
  const double limit = reach * reach;
  return square < limit * (1 - 0x1p-46) && limit >= 0x1p-900 && limit <= 0x1p1000;
}

/// Returns the sign of |a - b| - r - s - distance exactly. All arguments are finite; radii and distance are
/// not negative.
[[nodiscard]] int compare_separation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s,
                                     double distance);

template <int Dimension>
[[nodiscard]] Eigen::Vector3d in_space(const Point<Dimension>& point) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < Dimension; ++axis) vector[static_cast<Eigen::Index>(axis)] = point[axis];
  return vector;
}

/// Returns whether the closed balls are at most `distance` apart. At distance 0 this asks whether they have a
/// common point.
template <int Dimension>
[[nodiscard]] bool within(const Point<Dimension>& a, const Point<Dimension>& b, double r, double s,
                          double distance) {
  const Point<Dimension> d = detail::minus(a, b);
  const double square = detail::dot(d, d), reach = r + s + distance;
  if (surely_apart(square, reach)) return false;
  return surely_within(square, reach) ||
         compare_separation(in_space<Dimension>(a), in_space<Dimension>(b), r, s, distance) <= 0;
}

namespace detail {

/// Not inline. Falls back on rationals if doubles do not decide.
template <int Dimension>
[[nodiscard]] bool balls_meet_exactly(const Balls<Dimension>& balls, BeadId a, BeadId b);

}  // namespace detail

/// Returns exactly whether two closed balls meet; touching balls meet. Inline in loops over candidates.
/// `reach` is the sum of the radii as a double.
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
  std::vector<std::size_t> starts_;
  std::vector<BeadPair> sorted_;
};

}  // namespace kds
