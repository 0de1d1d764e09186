#pragma once
// Exact comparisons of balls whose numbers are doubles. Each one first tries doubles with an error bound,
// then falls back on rationals.

#include <Eigen/Core>

namespace kds {

/// The exact, unrounded sum of two doubles.
struct ExactSum {
  double first = 0, second = 0;
};

/// Returns the sign of |a - b|^2 - (r + s)^2 exactly. With the radii of two balls, the sign is positive if
/// the balls are disjoint and zero if they touch from outside. If s is a negated radius, zero means that the
/// balls touch from inside. All arguments are finite.
[[nodiscard]] int compare_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s);

/// Returns the sign of |a - b|^2 factor^2 - |c - d|^2 exactly. All arguments are finite, and factor is not
/// negative.
[[nodiscard]] int compare_lengths(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double factor,
                                  const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Returns the sign of (|a - b| - r) - (|c - d| - s) exactly. The sign tells which two balls are farther
/// apart if r and s are the sums of their radii. All arguments are finite.
[[nodiscard]] int compare_gaps(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const ExactSum& r,
                               const Eigen::Vector3d& c, const Eigen::Vector3d& d, const ExactSum& s);

/// Returns the sign of (|x - a|^2 - v) - (|x - b|^2 - w) exactly: which power is larger at x. All arguments
/// are finite.
[[nodiscard]] int compare_powers(const Eigen::Vector3d& x, const Eigen::Vector3d& a, double v,
                                 const Eigen::Vector3d& b, double w);

/// Returns the sign of x factor - y exactly. All arguments are finite and none is negative.
[[nodiscard]] int compare_products(double x, double factor, double y);

}  // namespace kds
