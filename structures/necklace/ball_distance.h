#pragma once
// Exact comparisons of balls whose numbers are doubles: in double with an error bound, else on rationals.

#include <Eigen/Core>

namespace kds {

/// The sum of two doubles, meant exactly.
struct ExactSum {
  double first = 0, second = 0;
};

/// The sign of |a - b|^2 - (r + s)^2. With the radii of two balls: positive while they are disjoint, zero
/// where they touch from outside; with s taken negative, zero where they touch from inside. All finite.
/// Exact.
[[nodiscard]] int compare_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

/// The sign of |a - b|^2 factor^2 - |c - d|^2. All finite, factor not negative. Exact.
[[nodiscard]] int compare_lengths(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double factor,
                                  const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// The sign of (|a - b| - r) - (|c - d| - s): which two balls are farther apart, r and s the sums of their
/// radii. All finite. Exact.
[[nodiscard]] int compare_gaps(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const ExactSum& r,
                               const Eigen::Vector3d& c, const Eigen::Vector3d& d, const ExactSum& s);

/// The sign of (|x - a|^2 - v) - (|x - b|^2 - w): whose power is larger at x. All finite. Exact.
[[nodiscard]] int compare_powers(const Eigen::Vector3d& x, const Eigen::Vector3d& a, double v,
                                 const Eigen::Vector3d& b, double w);

/// The sign of x factor - y. All finite, none negative. Exact.
[[nodiscard]] int compare_products(double x, double factor, double y);

}  // namespace kds
