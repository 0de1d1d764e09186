#include "structures/collision/balls_meet.h"

#include <algorithm>

#include "structures/necklace/ball_distance.h"

namespace kds {

int compare_separation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double r, double s,
                       double distance) {
  if (distance == 0) return compare_distance(a, b, r, s);
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero(), beyond(distance, 0, 0);
  return compare_gaps(a, b, {r, s}, origin, beyond, {});
}

namespace detail {

template <int Dimension>
bool balls_meet_exactly(const Balls<Dimension>& balls, BeadId a, BeadId b) {
  const auto center = [&balls](BeadId bead) { return in_space<Dimension>(detail::center_of(balls, bead)); };
  return compare_distance(center(a), center(b), balls.radius(a), balls.radius(b)) <= 0;
}

template bool balls_meet_exactly(const Balls<2>&, BeadId, BeadId);
template bool balls_meet_exactly(const Balls<3>&, BeadId, BeadId);

}  // namespace detail

void PairSorter::sort(std::vector<BeadPair>& pairs, std::size_t beads) {
  if (pairs.size() < beads / 16) return std::sort(pairs.begin(), pairs.end());
  // Counting sort by the first bead; few pairs share one.
  starts_.assign(beads + 1, 0);
  for (const BeadPair& pair : pairs) ++starts_[pair.first + 1];
  for (std::size_t b = 0; b < beads; ++b) starts_[b + 1] += starts_[b];
  sorted_.resize(pairs.size());
  for (const BeadPair& pair : pairs) sorted_[starts_[pair.first]++] = pair;
  for (std::size_t begin = 0; begin < sorted_.size();) {
    const auto end = starts_[sorted_[begin].first];
    std::sort(sorted_.begin() + static_cast<std::ptrdiff_t>(begin),
              sorted_.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  pairs.swap(sorted_);
}

}  // namespace kds
