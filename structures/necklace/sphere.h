#pragma once
// A sphere for people and programs to read: rounded.

#include <Eigen/Core>

namespace kds {

/// In the plane a circle, its third coordinate 0.
struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

}  // namespace kds
