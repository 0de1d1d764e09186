#pragma once
// Finds all pairs of beads that meet with a linear BVH on vectors, following the paper's idea of grouping
// beads in sequence. Blocks hold 16 beads in float, with four boxes of four beads each, and a tree with 16
// children per node lies above them. The search descends into pairs of nodes whose boxes meet, level by
// level, 16 boxes at once. A pair of blocks then compares its 16 pairs of boxes at once, and a pair of boxes
// its 16 pairs of beads. Floats serve only to rule pairs out (proof in float_conversion.h). The remaining
// pairs are decided exactly. The tree is built anew for every scene, in 1 to 2 ns per bead.
//
// Blocks along a straight or nearly straight piece of chain are compared neither with themselves nor with the
// next block. Each bead there lies so far ahead of the bead before it in one direction that no pair asked
// about can meet.
//
// If blocks of consecutive beads meet many others, the boxes are turned to the chain's bonds
// (float_conversion.h), provided that the bonds lie along few directions. If turned boxes still meet many
// others, or if the bonds have no such directions, the beads are sorted along a Morton curve, which costs
// time, and blocks are made in this spatial order. Both decisions are made after an eighth of the work.
//
// The result is exact for all finite input. The time depends on the input. Coordinates that are huge compared
// with distances and radii (10^5 times and more) make the filter less effective, and widely different radii
// make the boxes less effective. In the worst case all pairs are tested.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "structures/blocks/block_loops.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/bead_blocks.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

template <int Dimension>
class BlockTree {
 public:
  /// Counts of the last search, equal on every machine.
  struct Counts {
    std::uint64_t node_pairs = 0;  ///< pairs of nodes above blocks
    std::uint64_t block_pairs = 0;
    std::uint64_t group_pairs = 0;  ///< pairs of groups of four beads
    std::uint64_t candidates = 0;   ///< pairs that the float filter left
  };

  /// Without `order`, the tree chooses the order that seems faster. Throws std::invalid_argument unless
  /// `asked` names a scene's necklaces one after the other and the target is available.
  explicit BlockTree(PairsAsked asked, std::optional<BlockOrder> order = std::nullopt,
                     VectorTarget target = widest_vector_target());

  [[nodiscard]] const PairsAsked& asked() const { return blocks_.asked(); }
  [[nodiscard]] std::size_t bead_count() const { return blocks_.bead_count(); }

  /// Returns all pairs asked about that meet, in order. The result is valid until the next call. Throws
  /// std::invalid_argument if the number of balls differs from the number of beads in the necklaces.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls);
  /// Returns pairs(), or null if the float filter leaves more than `most` pairs. The search stops soon after
  /// it exceeds this number.
  const std::vector<BeadPair>* pairs_unless(const Balls<Dimension>& balls, std::size_t most);

  /// Returns all pairs asked about that are at most `gap` apart (finite, not negative), and some pairs
  /// slightly farther apart, in no particular order. Returns none if there are more than `most`; the search
  /// stops soon after it exceeds this number.
  std::optional<std::span<const BeadPair>> near_pairs(const Balls<Dimension>& balls, double gap,
                                                      std::size_t most);

  /// Returns an upper bound of the distance of a bead from its position in the last search. NaN and infinity
  /// are no bounds. The number of balls must be unchanged.
  [[nodiscard]] double strayed(const Balls<Dimension>& balls) { return blocks_.strayed(balls); }
  /// Returns the bounds of strayed() for the beads of each block.
  [[nodiscard]] std::span<const double> strayed_by_block(const Balls<Dimension>& balls) {
    return blocks_.strayed_by_block(balls);
  }

  /// Call it after near_pairs. Updates the positions of the beads of these blocks (ascending) and of no
  /// others. Returns all pairs asked about that contain such a bead and are at most the previous gap apart,
  /// and some pairs slightly farther apart. All other beads count at the positions of the last search.
  /// Returns none if there are more than `most` pairs or if beads have left the range of the conversion; then
  /// all must be searched again. Radii must be unchanged.
  std::optional<std::span<const BeadPair>> near_pairs_of(const Balls<Dimension>& balls,
                                                         std::span<const std::uint32_t> blocks,
                                                         std::size_t most);
  /// Returns a mark per bead, nonzero for the beads of the blocks that near_pairs_of was given last.
  [[nodiscard]] std::span<const unsigned char> looked_at_again() const { return marked_beads_; }

  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] BlockOrder order() const { return blocks_.order(); }
  /// Returns the conversion of the last scene.
  [[nodiscard]] const FloatConversion<Dimension>& conversion() const { return blocks_.conversion(); }
  /// Sets the axes of the boxes for the next searches, none for the coordinate axes. The axes hold until the
  /// tree makes its choices anew.
  void turn(const std::optional<Axes<Dimension>>& axes) { blocks_.turn(axes); }
  /// Announces a new scene: the next search tries sequence order first again, with boxes along the coordinate
  /// axes.
  void forget_order() { searches_since_choice_ = most_searches_as_chosen; }

 private:
  struct PairList {
    std::vector<std::uint32_t> first, second;
    std::size_t count = 0;
    /// Makes room for `more` elements and for the padding that loops may write.
    void reserve(std::size_t more) {
      const std::size_t needed = count + more + loop_padding;
      if (first.size() >= needed) return;
      first.resize(2 * needed);
      second.resize(2 * needed);
    }
    [[nodiscard]] NodePairs end() { return {first.data() + count, second.data() + count}; }
  };

  void mark(std::span<const std::uint32_t> blocks);
  void keep_marked(PairList& pairs, std::size_t from, std::size_t level) const;

  void find_candidates(const Balls<Dimension>& balls, double gap, std::size_t most);
  // Number of searches after which sequence order is tried again.
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
  const BlockLoops<Dimension>& loops_;
  BeadBlocks<Dimension> blocks_;
  bool may_turn_ = true;                      // bonds have not been tested for axes yet
  std::optional<Axes<Dimension>> bond_axes_;  // axes for a conversion that is to be turned
  std::uint64_t searches_since_choice_ = 0;

  // Marks of the blocks that are searched again, of the nodes above them level by level, and of their beads.
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
