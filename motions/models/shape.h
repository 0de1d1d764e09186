#pragma once
// Definitions common to all models. A shape has beads of radius 1, one column each.

#include <Eigen/Core>
#include <cstddef>

namespace kds::models {

using Shape = Eigen::Matrix3Xd;

inline constexpr double radius = 1;

/// The distance of consecutive beads divided by their diameter. They overlap by a thousandth, so coordinates
/// rounded to three decimals (PDB) still give a connected necklace.
inline constexpr double usual_bond = 0.999;

/// The distance that models keep between nonadjacent beads, with a margin for the same rounding.
inline constexpr double clear_distance = 2.002;

/// Returns the squared distance, summed axis by axis in order, so that the result does not depend on how
/// Eigen vectorizes.
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
