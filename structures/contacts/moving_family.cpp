#include "structures/contacts/moving_family.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace kds {

template <int Dimension>
MovingFamily<Dimension>::MovingFamily(PairsAsked asked, int degree)
    : asked_(std::move(asked)),
      blocks_(blocks_of(asked_.necklaces)),
      boxes_(blocks_, degree),
      beads_(blocks_, degree) {}

template <int Dimension>
void MovingFamily<Dimension>::find_pairs(const Curves<Dimension>& curves, Resting resting,
                                         bool list_overlapping, PairsOfBlocks& pairs) {
  pairs.clear();
  size_ = 0;
  if (blocks_.empty()) return;
  boxes_.move_to(curves, blocks_);
  const std::size_t top = boxes_.level_count() - 1;
  std::array<double, Dimension> middle;
  double half = 0;
  for (int axis = 0; axis < Dimension; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t box = 0; box < boxes_.box_count(top); ++box) {
      for (int k = 0; k < boxes_.control_count(); ++k) {
        low = std::min(low, boxes_.side(top, box, k, axis, false));
        high = std::max(high, boxes_.side(top, box, k, axis, true));
      }
    }
    middle[static_cast<std::size_t>(axis)] = 0.5 * low + 0.5 * high;
    half = std::max(half, 0.5 * high - 0.5 * low);
  }
  beads_.move_to(curves, middle, half);
  near_blocks_.clear();
  split(resting, top + 1, 0, 0);
  beads_.look_at(near_blocks_, asked_.apart, list_overlapping, pairs);
}

// The children of two boxes of a level, or of one with itself; above the top one box holds all.
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
    std::uint32_t near = others & boxes_.near(below, child, second);
    size_ += static_cast<std::uint64_t>(std::popcount(others) - std::popcount(near));
    for (; near != 0; near &= near - 1) {
      const std::size_t other = second * fan + static_cast<std::size_t>(std::countr_zero(near));
      if (below > 0) {
        split(resting, below, child, other);
      } else if (asks(child, other)) {
        near_blocks_.push_back({static_cast<std::uint32_t>(child), static_cast<std::uint32_t>(other)});
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
