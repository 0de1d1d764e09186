#pragma once
// A hierarchy of moving boxes that encloses the balls of a step: boxes around blocks of beads, boxes around
// sixteen of these, and so on. A box moves with its beads. The box's sides are Bezier curves whose control
// points bound the beads' control points, radii included. The box holds its balls at all times, because a
// curve is a mean of its control points with nonnegative weights, and all curves of a degree share these
// weights.
//
// Two boxes are disjoint during the whole step if, along one axis, each control point of one lies beyond the
// matching control point of the other: the difference of their sides is then a curve with positive control
// points. Motion that both boxes share does not matter. Comparisons round nothing; sides are rounded outwards
// when they are computed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/contacts/bead_blocks.h"

namespace kds {

template <int Dimension>
class MovingBoxes {
 public:
  /// Number of boxes in a group. The boxes of a group are the children of one box above, and the tests handle
  /// all of them at once.
  static constexpr std::size_t fan = 16;
  using Bits = std::uint32_t;  ///< one bit per box of a group

  MovingBoxes(std::span<const BeadBlock> blocks, int degree);

  /// Takes the blocks' boxes for the step of these curves; call it once per step. arrange() computes the
  /// boxes above. Sides that overflow are infinite.
  void move_to(const Curves<Dimension>& curves, std::span<const BeadBlock> blocks);
  /// Groups the blocks in this order. Consecutive blocks should be near each other.
  void arrange(std::span<const std::uint32_t> order);
  /// Must be called if the beads' previous motion is unknown. No box then counts as at rest in the next step.
  void forget_rest();

  /// Level 0 holds the blocks as arranged. The last level has at most `fan` boxes.
  [[nodiscard]] std::size_t level_count() const { return levels_.size(); }
  [[nodiscard]] std::size_t box_count(std::size_t level) const { return levels_[level].count; }

  /// Returns the boxes of a group that may meet this box of the same level during the step. The group
  /// consists of the boxes from fan * group on.
  [[nodiscard]] Bits near(std::size_t level, std::size_t box, std::size_t group, Bits asked) const {
    const Level& l = levels_[level];
    return near_bits(&l.sides[box * sides_of_box()], &l.lanes[group * fan * sides_of_box()], controls_,
                     asked);
  }
  /// Returns the boxes of a group that exist.
  [[nodiscard]] Bits present(std::size_t level, std::size_t group) const {
    return levels_[level].present[group];
  }
  /// Returns the boxes of a group that hold only beads at rest in this step and in the previous one.
  [[nodiscard]] Bits at_rest(std::size_t level, std::size_t group) const {
    return levels_[level].rest[group];
  }

  /// Returns a side of a block's box at control point `k` along `axis`, the upper side if `upper`.
  [[nodiscard]] double side(std::size_t block, int k, int axis, bool upper) const {
    return sides_of_blocks_[block * sides_of_box() + place(k, axis, upper)];
  }
  [[nodiscard]] int control_count() const { return controls_; }

 private:
  struct Level {
    std::size_t count = 0;
    std::vector<double> sides;  // stored box by box
    std::vector<double> lanes;  // stored by groups, a box per lane
    std::vector<Bits> present, rest;
  };

  [[nodiscard]] std::size_t sides_of_box() const {
    return 2 * static_cast<std::size_t>(Dimension) * static_cast<std::size_t>(controls_);
  }
  [[nodiscard]] static constexpr std::size_t place(int k, int axis, bool upper) {
    return 2 * static_cast<std::size_t>(k * Dimension + axis) + (upper ? 1 : 0);
  }
  [[nodiscard]] static Bits near_bits(const double* box, const double* group, int controls, Bits asked);
  void bound_boxes_of(const Level& below, Level& level) const;
  void lay_in_lanes(Level& level) const;

  int controls_;  // control points per curve
  std::vector<double> sides_of_blocks_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> rests_, rested_;  // of each block: at rest in this step, and in the one before
};

}  // namespace kds
