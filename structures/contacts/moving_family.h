#pragma once
// Pairs of cages that are disjoint all over a step, and with them all pairs of beads that need not be looked
// at (Agarwal et al., section 3). The cages are moving boxes around runs of consecutive beads. A pair of
// boxes that is not proved disjoint is split; where both are blocks, their beads are looked at, four with
// four. The family is coarse again at the start of every step: what was split for one step need not be for
// the next.
//
// Boxes around blocks hold those that are near along the chain, where there are few blocks, else those that
// are near in space: a long chain that is packed tightly comes back to a place again and again. They are
// sorted anew when the family has grown.
//
// A pair that is disjoint for a part of the step only is split at the step's start and not when that part
// ends. Boxes that move with their beads leave next to nothing to wait for: of 171 pairs of blocks of a
// protein of 100 residues 20 may meet in a step of 20 fs, and 0.1 of these are disjoint at its start; of 2346
// pairs of one of 363 residues 223 may in a step of 100 fs, 6.1 are disjoint at its start, 0.085 at all times
// (balls 2.5 times as large as half the longest bond). Waiting would spare the beads of these 0.085, for an
// entry in the queue for each of the 6.1.

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

  /// Pairs at rest: whose beads do not move in this step, nor did in the one before. Nothing becomes of them.
  enum class Resting : std::uint8_t { left_out, looked_at };
  /// The motion is that of the first step: nothing is before.
  void forget_rest() { boxes_.forget_rest(); }
  /// Once a step. Finds the pairs of beads asked about that are not proved apart all over the step of these
  /// curves.
  void find_pairs(const Curves<Dimension>& curves, Resting resting, bool list_overlapping,
                  PairsOfBlocks& pairs);

  /// Pairs of boxes that it has.
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
  std::vector<std::uint32_t> order_;  // of blocks: those in one box one after the other
  std::vector<BlockPair> near_blocks_;
  std::uint64_t size_when_sorted_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace kds
