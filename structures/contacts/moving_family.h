#pragma once
// Pairs of cages that are disjoint during a whole step, which proves most pairs of beads disjoint
// (Agarwal et al., section 3). The cages are moving boxes around runs of consecutive beads. A pair of boxes
// that is not proved disjoint is split. If both boxes are blocks, their beads are tested, four against four.
// The family is coarse again at the start of every step, because a pair split for one step may not need it in
// the next.
//
// If there are few blocks, the boxes above them group blocks near along the chain. Otherwise they group
// blocks near in space, because a long, tightly packed chain returns to the same place again and again.
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
#include <cstdint>
#include <vector>

#include "structures/collision/pairs_asked.h"
#include "structures/contacts/block_beads.h"
#include "structures/contacts/moving_boxes.h"

namespace kds {

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
    double half;  // of the longest side
  };
  [[nodiscard]] Extent extent() const;
  void sort_blocks(const Extent& all);
  void split(Resting resting, std::size_t level, std::size_t first, std::size_t second);
  [[nodiscard]] bool asks(std::size_t first, std::size_t second) const;

  PairsAsked asked_;
  std::vector<BeadBlock> blocks_;
  MovingBoxes<Dimension> boxes_;
  BlockBeads<Dimension> beads_;
  std::vector<std::uint32_t> order_;  // of blocks, with the blocks of one box consecutive
  std::vector<BlockPair> near_blocks_;
  std::uint64_t size_when_sorted_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace kds
