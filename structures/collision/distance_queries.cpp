#include "structures/collision/distance_queries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "motions/base/floating_point_scope.h"
#include "structures/collision/hierarchy_search.h"

namespace kds {

template <int Dimension>
void DistanceQueries<Dimension>::offer_some(ClosestSoFar<Dimension>& closest) const {
  if (closest_before_) closest.offer(closest_before_->first, closest_before_->second);
  const PairsAsked& asked = tree_.asked();
  for (std::size_t n = 0; n < asked.necklaces.size(); ++n) {
    const BeadRange& range = asked.necklaces[n];
    for (std::size_t b = range.first; asked.asks_of(n, n) && b + asked.apart <= range.last; ++b)
      closest.offer(static_cast<BeadId>(b), static_cast<BeadId>(b + asked.apart));
    if (n > 0 && asked.asks_of(n - 1, n)) closest.offer(asked.necklaces[n - 1].last, range.first);
  }
}

// Returns whether the closest pair is among the offered pairs.
template <int Dimension>
bool DistanceQueries<Dimension>::search(const Balls<Dimension>& balls, double largest_radius,
                                        ClosestSoFar<Dimension>& closest) {
  constexpr int most_tries = 24;
  const std::size_t most = 32 * balls.size() + 1024;
  // The offered pairs may be far from the closest, so the search approaches its distance from below.
  double gap = std::max(0.0, closest.at_most());
  if (gap > largest_radius) gap /= 256;
  double none_within = 0, too_many_within = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_tries && gap < too_many_within; ++k) {
    if (const auto near = tree_.near_pairs(balls, gap, most)) {
      for (const BeadPair& pair : *near) closest.offer(pair.first, pair.second);
      if (closest.at_most() <= gap) return true;
      none_within = gap;
      gap = std::min(4 * gap, closest.at_most());
    } else {
      too_many_within = gap;
      gap = none_within > 0 ? std::min(4 * none_within, gap) : gap / 16;
    }
    if (gap >= too_many_within) gap = std::sqrt(none_within) * std::sqrt(too_many_within);
    if (!(gap > none_within)) return false;
  }
  return false;
}

template <int Dimension>
std::optional<ClosestPair> DistanceQueries<Dimension>::closest_pair(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  if (balls.size() != tree_.bead_count())
    throw std::invalid_argument("balls and necklaces must be of the same beads");
  ClosestSoFar<Dimension> closest(balls);
  offer_some(closest);
  std::optional<ClosestPair> result = closest.result();
  if (!result) return std::nullopt;  // no pair is asked about
  if (search(balls, scene_box(balls).largest_radius, closest)) {
    result = closest.result();
  } else {
    SphereTree<Dimension> spheres(Hierarchy::layered, tree_.asked().necklaces);
    spheres.build(balls);
    result = find_closest_pair(spheres, balls, tree_.asked());
  }
  closest_before_ = BeadPair{result->first, result->second};
  return result;
}

template <int Dimension>
const std::vector<BeadPair>& DistanceQueries<Dimension>::pairs_within(const Balls<Dimension>& balls,
                                                                      double distance) {
  const FloatingPointScope to_nearest;
  pairs_.clear();
  const auto near = tree_.near_pairs(balls, distance, std::numeric_limits<std::size_t>::max());
  for (const BeadPair& pair : near.value())
    if (balls_within(balls, pair.first, pair.second, distance)) pairs_.push_back(pair);
  sorter_.sort(pairs_, balls.size());
  return pairs_;
}

template class DistanceQueries<2>;
template class DistanceQueries<3>;

}  // namespace kds
