#pragma once
// What a user would do instead: build the structure anew at every frame with CGAL, in double. For comparing
// times.

#include <Eigen/Core>
#include <span>

#include "kds/seconds.h"
#include "motions/base/bead_range.h"

namespace kds {

/// What CGAL takes for the minimum enclosing sphere of every node (Min_sphere_of_spheres_d, its
/// defaults).
template <int Dimension>
[[nodiscard]] Seconds seconds_to_wrap(std::span<const BeadRange> nodes, const Eigen::Matrix3Xd& centers,
                                      std::span<const double> radii);

/// What it takes to sort the beads along the first axis.
[[nodiscard]] Seconds seconds_to_sort(const Eigen::Matrix3Xd& centers);

/// What it takes to find the least and the greatest coordinates.
[[nodiscard]] Seconds seconds_to_box(const Eigen::Matrix3Xd& centers);

/// What CGAL takes for the convex hull in the plane; the third row is not looked at.
[[nodiscard]] Seconds seconds_to_hull(const Eigen::Matrix3Xd& centers);

}  // namespace kds
