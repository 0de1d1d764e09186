#pragma once
// What a user would do instead: build the structure anew at every frame with CGAL, in double. For comparing
// times.

#include <Eigen/Core>
#include <span>

#include "motions/bead_range.h"

namespace kds {

/// Seconds that CGAL takes for the minimum enclosing sphere of every node (Min_sphere_of_spheres_d, its
/// defaults).
template <int Dimension>
[[nodiscard]] double seconds_to_wrap(std::span<const BeadRange> nodes, const Eigen::Matrix3Xd& centers,
                                     std::span<const double> radii);

/// The same in space, processor time of the process.
[[nodiscard]] double processor_seconds_to_wrap(std::span<const BeadRange> nodes,
                                               const Eigen::Matrix3Xd& centers,
                                               std::span<const double> radii);

/// Seconds to sort the beads along the first axis.
[[nodiscard]] double seconds_to_sort(const Eigen::Matrix3Xd& centers);

}  // namespace kds
