#include "structures/contacts/moving_family.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

namespace kds {

template <int Dimension>
MovingFamily<Dimension>::MovingFamily(PairsAsked asked, int degree)
    : asked_(std::move(asked)),
      blocks_(blocks_of(asked_.necklaces)),
      boxes_(blocks_, degree),
      beads_(blocks_, degree),
      order_(blocks_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
}

template <int Dimension>
void MovingFamily<Dimension>::find_pairs(const Curves<Dimension>& curves, Resting resting,
                                         bool list_overlapping, PairsOfBlocks& pairs) {
  // Up to this many blocks make at most three levels of boxes.
  constexpr std::size_t few = MovingBoxes<Dimension>::fan * MovingBoxes<Dimension>::fan;
  pairs.clear();
  if (blocks_.empty()) return;
  boxes_.move_to(curves, blocks_);
  const Extent all = extent();
  beads_.move_to(curves, all.middle, all.half);
  const bool has_grown = size_ > size_when_sorted_ + size_when_sorted_ / 2;
  const bool sorts = blocks_.size() > few && (size_when_sorted_ == 0 || has_grown);
  if (sorts) sort_blocks(all);
  boxes_.arrange(order_);
  size_ = 0;
  near_blocks_.clear();
  split(resting, boxes_.level_count(), 0, 0);
  if (sorts) size_when_sorted_ = size_;
  beads_.look_at(near_blocks_, asked_.apart, list_overlapping, pairs);
}

template <int Dimension>
auto MovingFamily<Dimension>::extent() const -> Extent {
  Extent all{};
  for (int axis = 0; axis < Dimension; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      for (int k = 0; k < boxes_.control_count(); ++k) {
        low = std::min(low, boxes_.side(block, k, axis, false));
        high = std::max(high, boxes_.side(block, k, axis, true));
      }
    }
    all.middle[static_cast<std::size_t>(axis)] = 0.5 * low + 0.5 * high;
    all.half = std::max(all.half, 0.5 * high - 0.5 * low);
  }
  return all;
}

// Sorts the blocks along a Morton curve. Any order is valid, so blocks whose place is unknown may go
// anywhere.
template <int Dimension>
void MovingFamily<Dimension>::sort_blocks(const Extent& all) {
  constexpr unsigned bits = 63 / Dimension;
  constexpr double most = static_cast<double>((std::uint64_t{1} << bits) - 1);
  std::vector<std::uint64_t> codes(blocks_.size(), 0);
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (int axis = 0; axis < Dimension; ++axis) {
      const double center =
          0.5 * boxes_.side(block, 0, axis, false) + 0.5 * boxes_.side(block, 0, axis, true);
      const double share = 0.5 + 0.5 * (center - all.middle[static_cast<std::size_t>(axis)]) / all.half;
      if (!(share >= 0 && share <= 1)) continue;
      const auto place = static_cast<std::uint64_t>(share * most);
      for (unsigned bit = 0; bit < bits; ++bit)
        codes[block] |= (place >> bit & 1U) << (bit * Dimension + static_cast<unsigned>(axis));
    }
  }
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return codes[a] != codes[b] ? codes[a] < codes[b] : a < b;
  });
}

// Splits two boxes of a level, or one box paired with itself, into pairs of their children. The top level
// counts as the children of one box.
template <int Dimension>
void MovingFamily<Dimension>::split(Resting resting, std::size_t level, std::size_t first,
                                    std::size_t second) {
  constexpr std::size_t fan = MovingBoxes<Dimension>::fan;
  const std::size_t below = level - 1;
  const std::size_t end = std::min(boxes_.box_count(below), (first + 1) * fan);
  const auto at_rest = [&](std::size_t group) {
    return resting == Resting::left_out ? boxes_.at_rest(below, group) : 0;
  };
  const std::uint32_t resting_first = at_rest(first), resting_second = at_rest(second);
  const std::uint32_t present = boxes_.present(below, second);
  for (std::size_t child = first * fan; child < end; ++child) {
    const std::size_t place = child - first * fan;
    std::uint32_t others = present;
    if (first == second) others &= ~std::uint32_t{0} << place;
    if ((resting_first >> place & 1U) != 0) others &= ~resting_second;
    if (others == 0) continue;
    std::uint32_t near = boxes_.near(below, child, second, others);
    size_ += static_cast<std::uint64_t>(std::popcount(others ^ near));
    for (; near != 0; near &= near - 1) {
      const std::size_t other = second * fan + static_cast<std::size_t>(std::countr_zero(near));
      if (below > 0) {
        split(resting, below, child, other);
      } else {
        const auto [a, b] = std::minmax(order_[child], order_[other]);
        if (asks(a, b)) near_blocks_.push_back({a, b});
      }
    }
  }
}

template <int Dimension>
bool MovingFamily<Dimension>::asks(std::size_t first, std::size_t second) const {
  return blocks_[first].necklace == blocks_[second].necklace ? asked_.within : asked_.between;
}

template class MovingFamily<2>;
template class MovingFamily<3>;

}  // namespace kds
