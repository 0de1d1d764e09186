#pragma once
// Measures the alternative to kinetic structures, for comparison: building each structure anew at every frame
// with CGAL, in doubles.

#include <Eigen/Core>
#include <span>

#include "kds/stopwatch.h"
#include "motions/base/bead.h"

namespace kds {

/// Measures the time that CGAL takes for the minimum enclosing spheres of all nodes (Min_sphere_of_spheres_d
/// with its defaults).
template <int Dimension>
[[nodiscard]] Seconds seconds_to_wrap(std::span<const BeadRange> nodes, const Eigen::Matrix3Xd& centers,
                                      std::span<const double> radii);

/// Measures the time to sort the beads along the first axis.
[[nodiscard]] Seconds seconds_to_sort(const Eigen::Matrix3Xd& centers);

/// Measures the time to find the least and the greatest coordinates.
[[nodiscard]] Seconds seconds_to_box(const Eigen::Matrix3Xd& centers);

/// Measures the time that CGAL takes for the convex hull in the plane; the third row is ignored.
[[nodiscard]] Seconds seconds_to_hull(const Eigen::Matrix3Xd& centers);

}  // namespace kds
