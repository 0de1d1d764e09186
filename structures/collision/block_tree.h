#pragma once
// All pairs of beads that meet, by the paper's idea of grouping them in sequence, on vectors: blocks of 16
// beads in float, four boxes of four beads in each, and a tree above them, 16 children a node. Pairs of nodes
// whose boxes meet are taken apart level by level, 16 boxes at once; of two blocks the 16 pairs of boxes at
// once; of two boxes the 16 pairs of beads. Floats only rule out (float_frame.h has the proof); what is left
// is decided exactly. Built anew for every scene, 1 to 2 ns a bead.
//
// Blocks along which a chain goes straight on, or nearly, are not compared with themselves and the next: each
// bead lies so far ahead of the one before it in one direction that none that are asked about can meet.
//
// Where blocks of consecutive beads meet many others, boxes are turned to the chain's bonds (bond_axes.h) if
// these lie along few directions. Where a chain is packed so densely that they still do, or has no such
// directions, the beads are put in spatial order first, along a Morton curve, and blocks are made of these:
// that costs sorting. Both are found out on an eighth of the work.
//
// Exact for all finite input. Time: coordinates that are huge beside distances and radii (10^5 times and
// more) blunt the filter, radii that differ widely the boxes; in the worst case all pairs are looked at.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "structures/blocks/block_kernels.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/bead_blocks.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

template <int Dimension>
class BlockTree {
 public:
  /// What the last search did; the same on every machine.
  struct Counts {
    std::uint64_t node_pairs = 0;  ///< of nodes above blocks
    std::uint64_t block_pairs = 0;
    std::uint64_t group_pairs = 0;  ///< four beads against four
    std::uint64_t candidates = 0;   ///< pairs that floats left
  };

  /// Without an order: whichever seems faster. Throws std::invalid_argument where `asked` does not name a
  /// scene's necklaces one after the other or the target is not available.
  explicit BlockTree(PairsAsked asked, std::optional<BlockOrder> order = std::nullopt,
                     VectorTarget target = widest_vector_target());

  [[nodiscard]] const PairsAsked& asked() const { return blocks_.asked(); }
  [[nodiscard]] std::size_t bead_count() const { return blocks_.bead_count(); }

  /// All pairs asked about that meet, in order. Valid until the next call. Throws std::invalid_argument where
  /// the balls are not as many as the necklaces have.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls);
  /// The same, but null where floats leave more than `most` pairs, which is found out before there are many
  /// more.
  const std::vector<BeadPair>* pairs_unless(const Balls<Dimension>& balls, std::size_t most);

  /// All pairs asked about that are at most `gap` apart (finite, not negative), and some that are little
  /// farther, in no order; none where there are more than `most`, which is found out before there are many
  /// more.
  std::optional<std::span<const BeadPair>> near_pairs(const Balls<Dimension>& balls, double gap,
                                                      std::size_t most);

  /// How far a bead is at most from where it was looked at last, rounded up; NaN and infinity are no bounds.
  /// As many balls as then.
  [[nodiscard]] double strayed(const Balls<Dimension>& balls) { return blocks_.strayed(balls); }
  /// The same of each block's beads.
  [[nodiscard]] std::span<const double> strayed_by_block(const Balls<Dimension>& balls) {
    return blocks_.strayed_by_block(balls);
  }

  /// After near_pairs: looks again where the beads of these blocks are (ascending) and at no others. All
  /// pairs asked about with such a bead that are at most the same gap apart, the others being where they were
  /// looked at last, and some that are little farther; none where there are more than `most` or beads have
  /// left the frame, and then all must be searched anew. The same radii as then.
  std::optional<std::span<const BeadPair>> near_pairs_of(const Balls<Dimension>& balls,
                                                         std::span<const std::uint32_t> blocks,
                                                         std::size_t most);
  /// Not zero for the beads of these blocks.
  [[nodiscard]] std::span<const unsigned char> looked_at_again() const { return marked_beads_; }

  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] BlockOrder order() const { return blocks_.order(); }
  /// Of the last scene.
  [[nodiscard]] const FloatFrame<Dimension>& frame() const { return blocks_.frame(); }
  /// The next searches are made in boxes along these axes, or the coordinates', until all is chosen anew.
  void turn(const std::optional<Axes<Dimension>>& axes) { blocks_.turn(axes); }
  /// A new scene: the sequence, in boxes along the coordinates' axes, is tried first again.
  void forget_order() { searches_since_choice_ = most_searches_as_chosen; }

 private:
  struct PairList {
    std::vector<std::uint32_t> first, second;
    std::size_t count = 0;
    /// Room for `more`, and for what kernels write behind.
    void reserve(std::size_t more) {
      const std::size_t needed = count + more + kernel_padding;
      if (first.size() >= needed) return;
      first.resize(2 * needed);
      second.resize(2 * needed);
    }
    [[nodiscard]] NodePairs end() { return {first.data() + count, second.data() + count}; }
  };

  void mark(std::span<const std::uint32_t> blocks);
  void keep_marked(PairList& pairs, std::size_t from, std::size_t level) const;

  void find_candidates(const Balls<Dimension>& balls, double gap, std::size_t most);
  // Then the sequence is tried again.
  static constexpr std::uint64_t most_searches_as_chosen = 64;
  enum class Outcome { found, better_turned, better_sorted };
  [[nodiscard]] Outcome search(const Balls<Dimension>& balls, bool may_give_up);
  void choose_anew();
  void expand_levels();
  [[nodiscard]] bool asks(std::uint32_t a, std::uint32_t b, std::size_t level) const;
  void compare_blocks();
  void compare_along();
  void compare_along(std::size_t first, std::size_t last);
  void reserve_candidates(std::size_t groups);

  std::optional<BlockOrder> wanted_;
  const BlockKernels<Dimension>& kernels_;
  BeadBlocks<Dimension> blocks_;
  bool may_turn_ = true;                      // it has not been asked yet whether bonds have axes
  std::optional<Axes<Dimension>> bond_axes_;  // of a frame that is to be turned
  std::uint64_t searches_since_choice_ = 0;

  // Of blocks that are looked at again, of the nodes above them level by level, and of their beads.
  bool only_marked_ = false;
  std::vector<std::vector<unsigned char>> marks_;
  std::vector<unsigned char> marked_beads_;
  std::vector<std::uint32_t> marked_blocks_;

  PairList nodes_, more_nodes_, block_pairs_;
  std::vector<std::uint32_t> groups_, near_groups_;
  std::vector<std::uint16_t> near_beads_;
  std::vector<BeadPair> candidates_, pairs_;
  std::size_t candidate_count_ = 0, most_candidates_ = 0;
  PairSorter sorter_;
  Counts counts_;
};

}  // namespace kds
