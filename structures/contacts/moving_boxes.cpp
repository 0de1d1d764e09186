#include "structures/contacts/moving_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace kds
