#include "structures/collision/closest_so_far.h"

#include <cmath>
#include <utility>

#include "structures/collision/separation.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

template <int Dimension>
Eigen::Vector3d ClosestSoFar<Dimension>::center(BeadId bead) const {
  return in_space<Dimension>(detail::center_of(*balls_, bead));
}

template <int Dimension>
void ClosestSoFar<Dimension>::offer(BeadId a, BeadId b) {
  if (b < a) std::swap(a, b);
  if (!best_) return take(a, b);
  const Point<Dimension> d = detail::minus(detail::center_of(*balls_, b), detail::center_of(*balls_, a));
  const double distance = std::sqrt(detail::dot(d, d));
  const double r = balls_->radius(a), s = balls_->radius(b);
  if (distance - (r + s) - error_of_gap(distance, r + s) > at_most_) return;
  const BeadId i = best_->first, j = best_->second;
  const int order = compare_gaps(center(a), center(b), {r, s}, center(i), center(j),
                                 {balls_->radius(i), balls_->radius(j)});
  if (order < 0 || (order == 0 && std::pair(a, b) < std::pair(i, j))) take(a, b);
}

template <int Dimension>
void ClosestSoFar<Dimension>::take(BeadId a, BeadId b) {
  const double distance = (center(a) - center(b)).stableNorm();
  const double reach = balls_->radius(a) + balls_->radius(b);
  best_ = ClosestPair{a, b, 0, distance - reach};
  at_most_ = distance - reach + error_of_gap(distance, reach);
  if (!(at_most_ < HUGE_VAL)) at_most_ = HUGE_VAL;
}

template <int Dimension>
std::optional<ClosestPair> ClosestSoFar<Dimension>::result() const {
  std::optional<ClosestPair> result = best_;
  if (result)
    result->sign = compare_distance(center(result->first), center(result->second),
                                    balls_->radius(result->first), balls_->radius(result->second));
  return result;
}

template class ClosestSoFar<2>;
template class ClosestSoFar<3>;

}  // namespace kds
