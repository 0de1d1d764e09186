#pragma once
// A sphere in rounded numbers, for output.

#include <Eigen/Core>

namespace kds {

/// In the plane the sphere is a circle whose third coordinate is 0.
struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

}  // namespace kds
