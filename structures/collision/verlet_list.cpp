#include "structures/collision/verlet_list.h"

#include "motions/base/floating_point_guard.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace {

/// Returns the greatest squared displacement of any of these points, given by rows with the numbers of one
/// axis.
template <std::size_t Dimension>
[[KDS_LANES_TARGETS]] double greatest_square(const std::array<const double*, Dimension>& now,
                                             const std::array<const double*, Dimension>& before,
                                             std::size_t count) {
  Lanes greatest(0.0);
  std::size_t b = 0;
  for (; b + Lanes::width <= count; b += Lanes::width) {
    Lanes square(0.0);
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const Lanes d(Lanes::load(now[axis] + b) - Lanes::load(before[axis] + b));
      square += d * d;
    }
    greatest = Lanes::max(greatest, square);
  }
  double result = 0;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane)
    result = greatest.v[lane] > result ? greatest.v[lane] : result;
  for (; b < count; ++b) {
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = now[axis][b] - before[axis][b];
      square += d * d;
    }
    result = square > result ? square : result;
  }
  return result;
}

}  // namespace

template <int Dimension>
bool VerletList<Dimension>::holds(const Balls<Dimension>& balls) const {
  if (made_at_[0].empty() || made_at_[0].size() != balls.size()) return false;
  const double limit = 0.25 * skin_ * skin_ * (1 - 0x1p-40);
  if (!(limit >= 0x1p-900 && limit <= 0x1p900)) return false;
  std::array<const double*, dimension> now, before;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    now[axis] = balls.coordinates(axis);
    before[axis] = made_at_[axis].data();
  }
  return greatest_square<dimension>(now, before, balls.size()) <= limit;
}

template <int Dimension>
void VerletList<Dimension>::rebuild(const Balls<Dimension>& balls) {
  ++rebuilds_;
  const auto near = cells_.near_pairs(balls, skin_);
  near_.assign(near.begin(), near.end());
  sorter_.sort(near_, balls.size());
  starts_.assign(balls.size() + 1, 0);
  others_.clear();
  for (const BeadPair& pair : near_) {
    ++starts_[pair.first + 1];
    others_.push_back(pair.second);
  }
  for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    const double* x = balls.coordinates(axis);
    made_at_[axis].assign(x, x + balls.size());
  }
}

template <int Dimension>
const std::vector<BeadPair>& VerletList<Dimension>::pairs(const Balls<Dimension>& balls) {
  const FloatingPointGuard to_nearest;
  if (!holds(balls)) rebuild(balls);
  pairs_.clear();
  const MeetingBalls meet(balls);
  for (BeadId a = 0; a < balls.size(); ++a) {
    for (std::uint32_t k = starts_[a]; k < starts_[a + 1]; ++k)
      if (meet(a, others_[k])) pairs_.push_back({a, others_[k]});
  }
  return pairs_;
}

template class VerletList<2>;
template class VerletList<3>;

}  // namespace kds
