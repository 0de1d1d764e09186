#include "motions/models/curve.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kds::models {

Shape beads_along(const Curve& curve, std::size_t beads, double bond, std::size_t pieces) {
  std::vector<Eigen::Vector3d> corners;
  std::vector<double> lengths;  // from the start to each corner
  for (std::size_t i = 0; i <= pieces; ++i) {
    corners.push_back(curve(static_cast<double>(i) / static_cast<double>(pieces)));
    lengths.push_back(i == 0 ? 0 : lengths.back() + std::sqrt(squared_distance(corners[i], corners[i - 1])));
  }
  const double gap = lengths.back() / static_cast<double>(beads - 1);
  const double scale = 2 * radius * bond / gap;
  Shape shape(3, static_cast<Eigen::Index>(beads));
  std::size_t piece = 1;
  for (std::size_t b = 0; b < beads; ++b) {
    const double place = std::min(gap * static_cast<double>(b), lengths.back());
    while (piece < pieces && lengths[piece] < place) ++piece;
    const double share = (place - lengths[piece - 1]) / (lengths[piece] - lengths[piece - 1]);
    shape.col(static_cast<Eigen::Index>(b)) =
        scale * ((1 - share) * corners[piece - 1] + share * corners[piece]);
  }
  return shape;
}

}  // namespace kds::models
