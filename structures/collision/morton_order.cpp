#include "structures/collision/morton_order.h"

#include <algorithm>
#include <bit>

namespace kds {

namespace {

// Spreads the bits to every `spread`-th position from the lowest.
std::uint64_t spread_bits(std::uint64_t bits, int spread) {
  std::uint64_t result = 0;
  for (int k = 0; bits >> k != 0; ++k) result |= (bits >> k & 1) << (k * spread);
  return result;
}

}  // namespace

template <int Dimension>
void MortonOrder<Dimension>::make_keys(const Balls<Dimension>& balls, int bits) {
  const auto cells = static_cast<double>((std::size_t{1} << bits) - 1);
  const SceneBox<Dimension> box = scene_box(balls);
  double longest = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    longest = std::max(longest, 0.5 * box.high[axis] - 0.5 * box.low[axis]);
  // If the scene is so small that this ratio is infinite, beads stay in the order of their numbers. Any order
  // is valid.
  const double cells_a_length = longest > 0 && cells / longest < 0x1p1000 ? cells / longest : 0.0;
  std::vector<std::uint64_t> spread(std::size_t{1} << bits);
  for (std::size_t k = 0; k < spread.size(); ++k) spread[k] = spread_bits(k, Dimension);
  keys_.resize(balls.size());
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double along = 0.5 * balls.coordinates(axis)[b] - 0.5 * box.low[axis];
      const double cell = std::min(along * cells_a_length, cells);
      key |= spread[static_cast<std::size_t>(static_cast<std::int64_t>(cell))] << axis;
    }
    keys_[b] = key << 32 | b;
  }
}

// Radix sort in two passes: by the lower half of the bits, then by the upper half.
template <int Dimension>
void MortonOrder<Dimension>::sort_keys(int key_bits) {
  const int half = (key_bits + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::vector<std::uint32_t> places;
  more_keys_.resize(keys_.size());
  for (const int shift : {32, 32 + half}) {
    places.assign(mask + 2, 0);
    for (const std::uint64_t key : keys_) ++places[(key >> shift & mask) + 1];
    for (std::size_t k = 0; k + 1 < places.size(); ++k) places[k + 1] += places[k];
    for (const std::uint64_t key : keys_) more_keys_[places[key >> shift & mask]++] = key;
    keys_.swap(more_keys_);
  }
}

template <int Dimension>
void MortonOrder<Dimension>::sort(const Balls<Dimension>& balls, std::vector<BeadId>& order) {
  const int bits = (std::bit_width(4 * balls.size()) + Dimension - 1) / Dimension;
  make_keys(balls, bits);
  sort_keys(bits * Dimension);
  order.resize(keys_.size());
  for (std::size_t k = 0; k < keys_.size(); ++k) order[k] = static_cast<BeadId>(keys_[k]);
}

template class MortonOrder<2>;
template class MortonOrder<3>;

}  // namespace kds
