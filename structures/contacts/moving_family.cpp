#include "structures/contacts/moving_family.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "motions/base/interruption.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A side is computed by one rounded sum. The error is at most 2^-53 of the side, and zero if the side is
// subnormal.
double rounded_down(double side) { return side - std::abs(side) * 0x1p-51; }
double rounded_up(double side) { return side + std::abs(side) * 0x1p-51; }

/// Loads a control point into lanes. The lanes after its coordinates are ignored in all computations.
template <int Dimension>
[[nodiscard, gnu::always_inline]] inline Lanes point_of(const Curves<Dimension>& curves, BeadId bead, int k) {
  const double* const p = curves.control_point(bead, k);
  if constexpr (Dimension == 3) {
    return Lanes::load(p);
  } else {
    return Lanes::Vector{p[0], p[1], 0, 0};
  }
}

/// Returns whether each of a few beads has equal control points throughout.
template <int Dimension>
bool all_rest(const Curves<Dimension>& curves, const BeadBlock& block, int controls) {
  for (BeadId b = block.first; b < block.first + block.count; ++b) {
    for (int k = 1; k < controls; ++k) {
      if (curves.radius(b, k) != curves.radius(b, 0)) return false;
      for (int axis = 0; axis < Dimension; ++axis)
        if (curves.coordinate(b, k, axis) != curves.coordinate(b, 0, axis)) return false;
    }
  }
  return true;
}

/// Computes bounds of the control points of a few beads.
template <int Dimension>
[[KDS_LANES_TARGETS]] void bound_beads(const Curves<Dimension>& curves, const BeadBlock& block, int controls,
                                       double* sides) {
  for (int k = 0; k < controls; ++k) {
    Lanes low(infinity), high(-infinity);
    for (BeadId b = block.first; b < block.first + block.count; ++b) {
      const Lanes point = point_of(curves, b, k), radius(curves.radius(b, k));
      low = Lanes::min(low, point - radius);
      high = Lanes::max(high, point + radius);
    }
    for (int axis = 0; axis < Dimension; ++axis) {
      *sides++ = rounded_down(low.v[axis]);
      *sides++ = rounded_up(high.v[axis]);
    }
  }
}

/// `Controls` is the number of control points per curve; 0 means that it is known at run time only.
template <int Dimension, int Controls>
[[KDS_LANES_TARGETS]] std::uint32_t near_in_lanes(const double* box, const double* group, int given,
                                                  std::uint32_t asked) {
  using Mask = Lanes::Mask;
  constexpr std::size_t fan = 16;
  const int controls = Controls == 0 ? given : Controls;
  Mask bits{0, 0, 0, 0};
  Mask weight{1, 2, 4, 8};
  for (std::size_t first = 0; first < fan; first += Lanes::width, weight *= 16) {
    if ((asked >> first & 15U) == 0) continue;
    Mask apart{0, 0, 0, 0};
    for (int axis = 0; axis < Dimension; ++axis) {
      Mask above{-1, -1, -1, -1}, below{-1, -1, -1, -1};
      for (int k = 0; k < controls; ++k) {
        const std::size_t lower = 2 * static_cast<std::size_t>(k * Dimension + axis), upper = lower + 1;
        above &= Lanes(Lanes::load(group + fan * lower + first)) > Lanes(box[upper]);
        below &= Lanes(Lanes::load(group + fan * upper + first)) < Lanes(box[lower]);
      }
      apart |= above | below;
    }
    bits |= ~apart & weight;
  }
  return asked & static_cast<std::uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

}  // namespace

template <int Dimension>
MovingBoxes<Dimension>::MovingBoxes(std::span<const BeadBlock> blocks, int degree) : controls_(degree + 1) {
  for (std::size_t count = blocks.size(); count > 0; count = (count + fan - 1) / fan) {
    Level& level = levels_.emplace_back();
    level.count = count;
    const std::size_t groups = (count + fan - 1) / fan;
    level.sides.resize(count * sides_of_box());
    level.lanes.resize(groups * fan * sides_of_box());
    level.rest.resize(groups);
    level.present.assign(groups, (1U << fan) - 1U);
    if (count % fan != 0) level.present.back() = (1U << (count % fan)) - 1U;
    if (count <= fan) break;
  }
  sides_of_blocks_.resize(blocks.size() * sides_of_box());
  rests_.assign(blocks.size(), 1);
  rested_ = rests_;
}

template <int Dimension>
void MovingBoxes<Dimension>::forget_rest() {
  std::fill(rests_.begin(), rests_.end(), 1);
}

template <int Dimension>
auto MovingBoxes<Dimension>::near_bits(const double* box, const double* group, int controls, Bits asked)
    -> Bits {
  return controls == 2 ? near_in_lanes<Dimension, 2>(box, group, controls, asked)
                       : near_in_lanes<Dimension, 0>(box, group, controls, asked);
}

template <int Dimension>
void MovingBoxes<Dimension>::move_to(const Curves<Dimension>& curves, std::span<const BeadBlock> blocks) {
  std::swap(rests_, rested_);
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    bound_beads(curves, blocks[block], controls_, &sides_of_blocks_[block * sides_of_box()]);
    rests_[block] = all_rest(curves, blocks[block], controls_) ? 1 : 0;
  }
}

template <int Dimension>
void MovingBoxes<Dimension>::arrange(std::span<const std::uint32_t> order) {
  if (levels_.empty()) return;
  const std::size_t sides = sides_of_box();
  Level& level = levels_.front();
  std::fill(level.rest.begin(), level.rest.end(), 0);
  for (std::size_t box = 0; box < order.size(); ++box) {
    const std::size_t block = order[box];
    std::copy_n(&sides_of_blocks_[block * sides], sides, &level.sides[box * sides]);
    if (rests_[block] != 0 && rested_[block] != 0) level.rest[box / fan] |= 1U << (box % fan);
  }
  lay_in_lanes(level);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    bound_boxes_of(levels_[l - 1], levels_[l]);
    lay_in_lanes(levels_[l]);
  }
}

template <int Dimension>
void MovingBoxes<Dimension>::bound_boxes_of(const Level& below, Level& level) const {
  const std::size_t sides = sides_of_box();
  std::fill(level.rest.begin(), level.rest.end(), 0);
  for (std::size_t box = 0; box < level.count; ++box) {
    double* const bounds = &level.sides[box * sides];
    const std::size_t end = std::min(below.count, (box + 1) * fan);
    std::copy_n(&below.sides[box * fan * sides], sides, bounds);
    for (std::size_t child = box * fan + 1; child < end; ++child) {
      const double* const inner = &below.sides[child * sides];
      for (std::size_t s = 0; s < sides; s += 2) {
        bounds[s] = std::min(bounds[s], inner[s]);
        bounds[s + 1] = std::max(bounds[s + 1], inner[s + 1]);
      }
    }
    if (below.rest[box] == below.present[box]) level.rest[box / fan] |= 1U << (box % fan);
  }
}

template <int Dimension>
void MovingBoxes<Dimension>::lay_in_lanes(Level& level) const {
  const std::size_t sides = sides_of_box();
  for (std::size_t box = 0; box < level.count; ++box) {
    double* const lanes = &level.lanes[(box / fan) * fan * sides + box % fan];
    for (std::size_t s = 0; s < sides; ++s) lanes[s * fan] = level.sides[box * sides + s];
  }
}

template class MovingBoxes<2>;
template class MovingBoxes<3>;

template <int Dimension>
MovingFamily<Dimension>::MovingFamily(PairsAsked asked, int degree)
    : asked_(std::move(asked)),
      blocks_(blocks_of(asked_.necklaces)),
      boxes_(blocks_, degree),
      beads_(blocks_, degree),
      order_(blocks_.size()) {
  check_groups(asked_);
  std::iota(order_.begin(), order_.end(), 0U);
  if (asked_.groups.empty()) return;
  for (const BeadBlock& block : blocks_) {
    std::uint8_t& groups = groups_of_blocks_.emplace_back();
    for (BeadId bead = block.first; bead < block.first + block.count; ++bead)
      groups = static_cast<std::uint8_t>(groups | asked_.groups[bead]);
  }
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
  if (asked_.groups.empty()) return;
  const auto is_within_a_group = [this](const BeadPair& pair) { return !asked_.joins_groups(pair); };
  std::erase_if(pairs.unclear, is_within_a_group);
  std::erase_if(pairs.overlapping, is_within_a_group);
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

// Sorts the blocks along a Morton curve. Any order is valid, so blocks whose position is unknown may go
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
      const auto position = static_cast<std::uint64_t>(share * most);
      for (unsigned bit = 0; bit < bits; ++bit)
        codes[block] |= (position >> bit & 1U) << (bit * Dimension + static_cast<unsigned>(axis));
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
  InterruptionCheck::ask();
  for (std::size_t child = first * fan; child < end; ++child) {
    const std::size_t index = child - first * fan;
    std::uint32_t others = present;
    if (first == second) others &= ~std::uint32_t{0} << index;
    if ((resting_first >> index & 1U) != 0) others &= ~resting_second;
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
  if (!groups_of_blocks_.empty() && !PairsAsked::joins(groups_of_blocks_[first], groups_of_blocks_[second]))
    return false;
  return asked_.asks_of(blocks_[first].necklace, blocks_[second].necklace);
}

template class MovingFamily<2>;
template class MovingFamily<3>;

}  // namespace kds
