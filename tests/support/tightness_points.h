#pragma once
// The points of Lemma 2.5 (Agarwal et al.): 2^h on the unit circle whose layered hierarchy, grouped in this
// order, has root radius sqrt(h). S_0 is one point and its centre; the next centre is the foot of the
// perpendicular from O to a line at distance 1/sqrt(h) from the last centre, and the next set adds the mirror
// image over the line through O and that foot; last, all are reflected through O.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace kds::test {

inline Eigen::Matrix3Xd tightness_points(int h) {
  // By angles: every point and centre lies on a ray from O, and a reflection is an angle's.
  std::vector<long double> angles{0};
  long double ray = 0, distance = 1;  // of the centre of what is covered so far
  const long double step = 1 / std::sqrt(static_cast<long double>(h));
  for (int level = 0; level + 1 < h; ++level) {
    const long double next = std::sqrt(distance * distance - step * step);
    ray += std::acos(next / distance);  // the right angle is at the foot
    distance = next;
    for (std::size_t i = 0, count = angles.size(); i < count; ++i) angles.push_back(2 * ray - angles[i]);
  }
  for (std::size_t i = 0, count = angles.size(); i < count; ++i)
    angles.push_back(angles[i] + std::acos(-1.0L));
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(angles.size()));
  for (std::size_t i = 0; i < angles.size(); ++i) {
    points(0, static_cast<Eigen::Index>(i)) = static_cast<double>(std::cos(angles[i]));
    points(1, static_cast<Eigen::Index>(i)) = static_cast<double>(std::sin(angles[i]));
  }
  return points;
}

}  // namespace kds::test
