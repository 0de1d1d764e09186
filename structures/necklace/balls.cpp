#include "structures/necklace/balls.h"

#include "motions/numbers/lanes.h"

namespace kds {

namespace {

/// The loop handles four beads at a time; memory beyond the last bead is writable.
template <int D>
[[KDS_LANES_TARGETS]] void spread_rows(const BallRow<D>* rows, std::size_t beads,
                                       const std::array<double*, static_cast<std::size_t>(D)>& centers) {
  for (std::size_t b = 0; b < beads; b += Lanes::width) {
    const auto numbers = Lanes::transposed(rows[b].center.data(), rows[b + 1].center.data(),
                                           rows[b + 2].center.data(), rows[b + 3].center.data());
    for (std::size_t axis = 0; axis < D; ++axis)
      __builtin_memcpy(centers[axis] + b, &numbers[axis].v, sizeof numbers[axis].v);
  }
}

}  // namespace

template <int D>
bool Balls<D>::copy(const Curves<D>& curves, int k, const Balls* start) {
  const auto [others_radii, start_is_known] = BallRows<D>::copy(curves, k, start);
  std::array<double*, static_cast<std::size_t>(D)> centers;
  for (std::size_t axis = 0; axis < D; ++axis) {
    centers_[axis].resize(rows_.size());
    centers[axis] = centers_[axis].data();
  }
  spread_rows(rows_.data(), size(), centers);
  if (others_radii) {
    radii_.resize(rows_.size());
    for (std::size_t b = 0; b < size(); ++b) radii_[b] = rows_[b].radius;
  }
  return start_is_known;
}

template class Balls<2>;
template class Balls<3>;

}  // namespace kds
