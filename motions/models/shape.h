#pragma once
// What all models share: beads of radius 1, one column each.

#include <Eigen/Core>
#include <cstddef>

namespace kds::models {

using Shape = Eigen::Matrix3Xd;

inline constexpr double radius = 1;

/// Distance of consecutive beads over their diameter: they overlap by a thousandth, so that coordinates
/// rounded to three decimals (PDB) still give a connected necklace.
inline constexpr double usual_bond = 0.999;

/// Models keep nonadjacent beads this far apart, for the same reason.
inline constexpr double clear_distance = 2.002;

/// Summed axis by axis in order, so that the result does not depend on how Eigen vectorises.
[[nodiscard]] inline double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

[[nodiscard]] inline Eigen::Vector3d centroid(const Shape& shape) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index bead = 0; bead < shape.cols(); ++bead) sum += shape.col(bead);
  return sum / static_cast<double>(shape.cols());
}

}  // namespace kds::models
