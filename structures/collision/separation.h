#pragma once
// Whether two balls are within a distance of each other, decided exactly: in double where a bound on its
// errors allows, else on rationals.

#include <Eigen/Core>

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

// With `square` a squared distance of centres and `reach` the sum of two radii and a distance, none of them
// negative, each rounded as it was computed. Their roundings come to less than 2^-49 of each; what underflows
// in one is below 2^-1000, where the other is at least 2^-900; infinity is larger than all that is finite, as
// then the exact number is too.

/// The balls are farther apart, for certain.
[[nodiscard]] inline bool surely_apart(double square, double reach) {
  return bool(int(square > reach * reach * (1 + 0x1p-46)) & int(square >= 0x1p-900));
}
/// They are not, for certain.
[[nodiscard]] inline bool surely_within(double square, double reach) {
  const double limit = reach * reach;
  return square < limit * (1 - 0x1p-46) && limit >= 0x1p-900 && limit <= 0x1p1000;
}

/// The sign of |a - b| - r - s - distance. All finite, radii and distance not negative. Exact.
[[nodiscard]] int compare_separation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s,
                                     double distance);

template <int Dimension>
[[nodiscard]] Eigen::Vector3d in_space(const Point<Dimension>& point) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < Dimension; ++axis) vector[static_cast<Eigen::Index>(axis)] = point[axis];
  return vector;
}

/// Whether the closed balls are at most so far apart; at a distance of 0, whether they have a point in
/// common.
template <int Dimension>
[[nodiscard]] bool within(const Point<Dimension>& a, const Point<Dimension>& b, double r, double s,
                          double distance) {
  const Point<Dimension> d = detail::minus(a, b);
  const double square = detail::dot(d, d), reach = r + s + distance;
  if (surely_apart(square, reach)) return false;
  return surely_within(square, reach) ||
         compare_separation(in_space<Dimension>(a), in_space<Dimension>(b), r, s, distance) <= 0;
}

}  // namespace kds
