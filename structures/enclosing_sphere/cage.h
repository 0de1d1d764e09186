#pragma once
// The sphere of a node of a hierarchy, in the form that its loops use.

#include "structures/enclosing_sphere/sphere_of_points.h"
#include "structures/necklace/ball_rows.h"
#include "structures/necklace/sphere.h"

namespace kds {

template <int Dimension>
using Cage = BallRow<Dimension>;

/// Converts a cage for output. If the cage encloses centres only, `wider` is the common radius of the beads;
/// it is added to the radius.
template <int Dimension>
[[nodiscard]] Sphere sphere_of(const Cage<Dimension>& cage, double wider) {
  Sphere sphere;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    sphere.center[static_cast<Eigen::Index>(axis)] = cage.center[axis];
  sphere.radius = cage.radius + wider;
  return sphere;
}

}  // namespace kds
