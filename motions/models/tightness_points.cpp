#include "motions/models/tightness_points.h"

#include <cmath>

namespace kds::models {

Eigen::Matrix3Xd tightness_points(int h) {
  const Eigen::Index count = Eigen::Index{1} << h;
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, count);
  points(0, 0) = 1;
  // The centre O_l of the first 2^l points lies at distance sqrt(1 - l/h) from the origin, and O_(l+1) at the
  // right angle of the triangle O O_(l+1) O_l whose leg O_l O_(l+1) is 1 / sqrt(h).
  double x = 1, y = 0;  // the direction of O_l
  Eigen::Index built = 1;
  for (int l = 0; l + 1 < h; ++l) {
    const double cosine = std::sqrt(static_cast<double>(h - l - 1) / (h - l));
    const double sine = std::sqrt(1.0 / (h - l));
    const double turned = x * cosine - y * sine;
    y = y * cosine + x * sine;
    x = turned;
    const double square = x * x + y * y;
    for (Eigen::Index p = 0; p < built; ++p) {  // mirrored about the line through O and O_(l+1)
      const double along = 2 * (x * points(0, p) + y * points(1, p)) / square;
      points(0, built + p) = along * x - points(0, p);
      points(1, built + p) = along * y - points(1, p);
    }
    built *= 2;
  }
  for (Eigen::Index p = 0; p < built; ++p) {
    points(0, built + p) = -points(0, p);
    points(1, built + p) = -points(1, p);
  }
  return points;
}

}  // namespace kds::models
