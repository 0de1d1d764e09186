#pragma once
// Pairs of cages that are disjoint during a whole step, which proves most pairs of beads disjoint
// (Agarwal et al., section 3). The cages are moving boxes around runs of consecutive beads. A pair of boxes
// that is not proved disjoint is split. If both boxes are blocks, their beads are tested, four against four.
// The family is coarse again at the start of every step, because a pair split for one step may not need it in
// the next.
//
// If there are few blocks, the boxes above them group blocks near along the chain. Otherwise they group
// blocks near in space, because a long, tightly packed chain returns to the same region again and again.
// Blocks are sorted again when the family has grown.
//
// A pair that is disjoint during only a part of the step is split at the start of the step and stays split. A
// certificate for such pairs would save little. Counts of pairs of blocks (balls 2.5 times as large as half
// the longest bond):
//
//   protein of         100 residues, steps of 20 fs   363 residues, steps of 100 fs
//   all pairs                      171                          2346
//   may meet in a step              20                           223
//   of these, disjoint at start      0.1                           6.1
//   of these, disjoint always                                      0.085
//
// A certificate would spare the tests of the beads in these 0.085 pairs and cost a queue entry for each of
// the 6.1.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/contacts/block_beads.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// A hierarchy of moving boxes that encloses the balls of a step: boxes around blocks of beads, boxes around
/// sixteen of these, and so on. A box moves with its beads. The box's sides are Bezier curves whose control
/// points bound the beads' control points, radii included. The box holds its balls at all times, because a
/// curve is a mean of its control points with nonnegative weights, and all curves of a degree share these
/// weights.
///
/// Two boxes are disjoint during the whole step if, along one axis, each control point of one lies beyond the
/// matching control point of the other: the difference of their sides is then a curve with positive control
/// points. Motion that both boxes share does not matter. Comparisons round nothing; sides are rounded
/// outwards when they are computed.
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
    return sides_of_blocks_[block * sides_of_box() + index(k, axis, upper)];
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
  [[nodiscard]] static constexpr std::size_t index(int k, int axis, bool upper) {
    return 2 * static_cast<std::size_t>(k * Dimension + axis) + (upper ? 1 : 0);
  }
  [[nodiscard]] static Bits near_bits(const double* box, const double* group, int controls, Bits asked);
  void bound_boxes_of(const Level& below, Level& level) const;
  void lay_in_lanes(Level& level) const;

  int controls_;  // control points per curve
  std::vector<double> sides_of_blocks_;
  std::vector<Level> levels_;
  std::vector<std::uint8_t> rests_, rested_;  // for each block: at rest in this step, and in the one before
};

template <int Dimension>
class MovingFamily {
 public:
  MovingFamily(PairsAsked asked, int degree);
  MovingFamily(const MovingFamily&) = delete;
  MovingFamily& operator=(const MovingFamily&) = delete;

  [[nodiscard]] const PairsAsked& asked() const { return asked_; }

  /// Pairs at rest: their beads do not move in this step and did not move in the previous one. The state of
  /// these pairs does not change.
  enum class Resting : std::uint8_t { left_out, looked_at };
  /// Must be called before a first step, which has no step before it.
  void forget_rest() { boxes_.forget_rest(); }
  /// Finds the pairs of beads asked about that are not proved apart during the whole step of these curves.
  /// Call it once per step.
  void find_pairs(const Curves<Dimension>& curves, Resting resting, bool list_overlapping,
                  PairsOfBlocks& pairs);

  /// Returns the number of pairs of boxes proved disjoint.
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  struct Extent {
    std::array<double, Dimension> middle;
    double half;  // half of the longest side
  };
  [[nodiscard]] Extent extent() const;
  void sort_blocks(const Extent& all);
  void split(Resting resting, std::size_t level, std::size_t first, std::size_t second);
  [[nodiscard]] bool asks(std::size_t first, std::size_t second) const;

  PairsAsked asked_;
  std::vector<BeadBlock> blocks_;
  std::vector<std::uint8_t> groups_of_blocks_;  // groups that occur in each block; empty without groups
  MovingBoxes<Dimension> boxes_;
  BlockBeads<Dimension> beads_;
  std::vector<std::uint32_t> order_;  // blocks in order, with the blocks of one box consecutive
  std::vector<BlockPair> near_blocks_;
  std::uint64_t size_when_sorted_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace kds
