#pragma once
// Cages of the balls of a step: boxes around blocks of beads, boxes around sixteen of those, and so on. A box
// moves as its beads do: its sides are Bezier curves whose control points bound those of the beads, radii
// included. It holds its balls at all times, as a curve is a mean of its control points with weights that are
// never negative, the same for all curves of a degree.
//
// Two boxes are disjoint all over the step if along one axis all control points of one lie beyond those of
// the other: that difference of sides is a curve with positive control points. What both boxes share of their
// motion does not matter. Nothing is rounded in a comparison; sides are rounded outwards when they are made.

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
  /// Boxes of a level side by side, of which the tests look at all at once: the children of one box above.
  static constexpr std::size_t fan = 16;
  using Bits = std::uint32_t;  ///< one a box of a group

  MovingBoxes(std::span<const BeadBlock> blocks, int degree);

  /// Takes the blocks' boxes for the step of these curves, once a step; boxes around them come with
  /// arrange(). Sides that overflow are infinite.
  void move_to(const Curves<Dimension>& curves, std::span<const BeadBlock> blocks);
  /// Groups the blocks in this order: those that follow each other should be near each other.
  void arrange(std::span<const std::uint32_t> order);
  /// Beads move, it is not known from when on: nothing is at rest before the first step.
  void forget_rest();

  /// Level 0: the blocks, as they are arranged. The last has at most `fan` boxes.
  [[nodiscard]] std::size_t level_count() const { return levels_.size(); }
  [[nodiscard]] std::size_t box_count(std::size_t level) const { return levels_[level].count; }

  /// Which of these boxes of a group, those from fan * group on, may meet this box of the same level in the
  /// step.
  [[nodiscard]] Bits near(std::size_t level, std::size_t box, std::size_t group, Bits asked) const {
    const Level& l = levels_[level];
    return near_bits(&l.sides[box * sides_of_box()], &l.lanes[group * fan * sides_of_box()], controls_,
                     asked);
  }
  /// Which boxes of a group there are.
  [[nodiscard]] Bits present(std::size_t level, std::size_t group) const {
    return levels_[level].present[group];
  }
  /// Which boxes of a group hold only beads that rest in this step and rested in the one before.
  [[nodiscard]] Bits at_rest(std::size_t level, std::size_t group) const {
    return levels_[level].rest[group];
  }

  /// A side of a block's box: control point, axis, and whether it is the upper one.
  [[nodiscard]] double side(std::size_t block, int k, int axis, bool upper) const {
    return sides_of_blocks_[block * sides_of_box() + place(k, axis, upper)];
  }
  [[nodiscard]] int control_count() const { return controls_; }

 private:
  struct Level {
    std::size_t count = 0;
    std::vector<double> sides;  // of each box in a row
    std::vector<double> lanes;  // the same, side by side for the boxes of a group
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

  int controls_;  // a curve
  std::vector<double> sides_of_blocks_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> rests_, rested_;  // of each block: in this step, in the one before
};

}  // namespace kds
