#pragma once
// Spheres from bases, and minimum enclosing spheres of points in double: approximate, a guess to be verified
// exactly. Beads of equal radius r: the sphere of their centres, r wider.

#include <Eigen/Core>

#include "structures/basis.h"

namespace kds {

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// The smallest sphere through the basis' centres. Approximate: rounding grows with the flatness of the
/// basis.
[[nodiscard]] Sphere sphere_of(const Basis& basis, const Eigen::Matrix3Xd& centers);
/// The same in exact arithmetic, rounded once a coordinate.
[[nodiscard]] Sphere exact_sphere_of(const Basis& basis, const Eigen::Matrix3Xd& centers);

/// A basis of beads first..last, most likely the right one; pivots from `guess`. Bounded work.
[[nodiscard]] Basis likely_basis(BeadId first, BeadId last, Basis guess, const Eigen::Matrix3Xd& centers);

}  // namespace kds
