#include "structures/hierarchy/bead_orders.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace kds {

namespace {

// Cuts where NecklaceTree does.
void cut_by_space(const Eigen::Matrix3Xd& centers, std::span<BeadId> beads) {
  if (beads.size() < 3) return;
  Eigen::Vector3d least = centers.col(beads.front()), most = least;
  for (const BeadId b : beads) {
    least = least.cwiseMin(centers.col(b));
    most = most.cwiseMax(centers.col(b));
  }
  Eigen::Index axis = 0;
  (most - least).maxCoeff(&axis);
  const auto place = [&](BeadId b) { return std::pair(centers(axis, b), b); };
  const std::size_t half = (beads.size() + 1) / 2;
  std::ranges::nth_element(beads, beads.begin() + static_cast<std::ptrdiff_t>(half), {}, place);
  cut_by_space(centers, beads.first(half));
  cut_by_space(centers, beads.subspan(half));
}

}  // namespace

std::vector<BeadId> order_by_space(const Eigen::Matrix3Xd& centers) {
  std::vector<BeadId> order(static_cast<std::size_t>(centers.cols()));
  std::iota(order.begin(), order.end(), BeadId{0});
  cut_by_space(centers, order);
  return order;
}

std::vector<BeadId> order_by_antipodes(std::size_t n) {
  if (n % 2 != 0) throw std::invalid_argument("an odd number of beads has no antipodal pairs");
  std::vector<BeadId> order;
  for (std::size_t i = 0; i < n / 2; ++i) {
    order.push_back(static_cast<BeadId>(i));
    order.push_back(static_cast<BeadId>(i + n / 2));
  }
  return order;
}

Eigen::Matrix3Xd in_order(const Eigen::Matrix3Xd& centers, std::span<const BeadId> order) {
  Eigen::Matrix3Xd ordered(3, static_cast<Eigen::Index>(order.size()));
  for (std::size_t k = 0; k < order.size(); ++k)
    ordered.col(static_cast<Eigen::Index>(k)) = centers.col(order[k]);
  return ordered;
}

}  // namespace kds
