#include "motions/models/tightness_points.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace kds::models {

Eigen::Matrix3Xd tightness_points(int h) {
  // Works with angles: every point and every centre lies on a ray from the origin, so mirroring a point
  // mirrors its angle.
  std::vector<long double> angles{0};
  long double ray = 0, distance = 1;  // of the centre O_l of the first 2^l points
  const long double leg = 1 / std::sqrt(static_cast<long double>(h));
  for (int l = 0; l + 1 < h; ++l) {
    // O_(l+1) is at the right angle of the triangle O O_(l+1) O_l whose leg O_l O_(l+1) is 1 / sqrt(h).
    const long double next = std::sqrt(distance * distance - leg * leg);
    ray += std::acos(next / distance);
    distance = next;
    for (std::size_t i = 0, built = angles.size(); i < built; ++i) angles.push_back(2 * ray - angles[i]);
  }
  const auto half = static_cast<Eigen::Index>(angles.size());
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2 * half);
  for (Eigen::Index p = 0; p < half; ++p) {
    const long double angle = angles[static_cast<std::size_t>(p)];
    points(0, p) = static_cast<double>(std::cos(angle));
    points(1, p) = static_cast<double>(std::sin(angle));
  }
  points.rightCols(half) = -points.leftCols(half);
  return points;
}

}  // namespace kds::models
