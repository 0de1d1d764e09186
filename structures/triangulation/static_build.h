#pragma once
// The alternative to kinetic structures, for comparison: builds of a structure from nothing, as a user would
// do them at every frame without this library. Each function converts its input and returns one build as a
// function, which can be timed by seconds_of or seconds_per_call. Builds are in doubles.

#include <Eigen/Core>
#include <functional>
#include <span>

#include "motions/base/bead.h"

namespace kds {

/// A build of one structure. Each call does the whole build.
using StaticBuild = std::function<void()>;

/// Builds the minimum enclosing spheres of all nodes with CGAL (Min_sphere_of_spheres_d with its defaults).
/// The caller keeps `nodes`.
template <int Dimension>
[[nodiscard]] StaticBuild spheres_by_cgal(std::span<const BeadRange> nodes, const Eigen::Matrix3Xd& centers,
                                          std::span<const double> radii);

/// Builds the regular triangulation with CGAL.
template <int Dimension>
[[nodiscard]] StaticBuild triangulation_by_cgal(const Eigen::Matrix3Xd& centers,
                                                std::span<const double> weights);

/// Builds the convex hull in the plane with CGAL. The third row is ignored.
[[nodiscard]] StaticBuild hull_by_cgal(const Eigen::Matrix3Xd& centers);

/// Sorts the beads along the first axis.
[[nodiscard]] StaticBuild order_by_sorting(const Eigen::Matrix3Xd& centers);

/// Finds the least and the greatest coordinates.
[[nodiscard]] StaticBuild box_by_scanning(const Eigen::Matrix3Xd& centers);

}  // namespace kds
