#pragma once
// What a user would do instead: build the structure anew at every frame with CGAL, in double. For comparing
// times.

#include <Eigen/Core>
#include <span>

#include "structures/necklace_tree.h"

namespace kds {

/// Seconds that CGAL takes for the minimum enclosing sphere at every node (Min_sphere_of_spheres_d, its
/// defaults).
[[nodiscard]] double seconds_to_wrap(const NecklaceTree& tree, const Eigen::Matrix3Xd& centers,
                                     std::span<const double> radii);

/// The same, processor time of the process.
[[nodiscard]] double processor_seconds_to_wrap(const NecklaceTree& tree, const Eigen::Matrix3Xd& centers,
                                               std::span<const double> radii);

/// Seconds to sort the beads along the first axis.
[[nodiscard]] double seconds_to_sort(const Eigen::Matrix3Xd& centers);

}  // namespace kds
