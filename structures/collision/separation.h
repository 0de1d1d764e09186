#pragma once
// Decides exactly whether two balls are within a distance of each other: in double if an error bound allows
// it, else on rationals.

#include <Eigen/Core>

#include "structures/enclosing_sphere/sphere_of_points.h"

namespace kds {

// In these functions, `square` is a squared distance of centres, and `reach` is the sum of two radii and a
// distance. Neither is negative, and each is rounded as it was computed. The roundings are below 2^-49 of
// each number. Underflow in one number is below 2^-1000, while the other is at least 2^-900. Infinity
// compares as larger than all finite numbers, as the exact number would.

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

}  // namespace kds
