#pragma once
// The beads of a scene in blocks of 16, in float. Four boxes cover four beads each in a block, and a tree
// lies above: nodes of 16 blocks, nodes of 16 nodes, and so on. A BlockTree searches this data. In sequence
// order, a block holds consecutive beads of one necklace, and the last block of a necklace may hold fewer. In
// spatial order, a block holds consecutive beads along a Morton curve. Lanes without a bead are NaN, which is
// near nothing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "structures/blocks/block_loops.h"
#include "structures/blocks/float_conversion.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Sorts beads along a Morton curve (Z-order). Beads near in this order are mostly near in space. Reuses its
/// memory from one sort to the next.
template <int Dimension>
class MortonOrder {
 public:
  /// Writes all beads to `order`, sorted by the cell that holds their centre, and by number within a cell. If
  /// the beads were evenly spread, a cell would hold about a fourth of a bead. If the scene is so small that
  /// cells cannot be distinguished, beads are sorted by number.
  void sort(const Balls<Dimension>& balls, std::vector<BeadId>& order);

 private:
  void make_keys(const Balls<Dimension>& balls, int bits);
  void sort_keys(int key_bits);

  std::vector<std::uint64_t> keys_, more_keys_;  // cell in the upper bits, bead in the lower 32 bits
};

enum class BlockOrder { sequence, spatial };

template <int Dimension>
class BeadBlocks {
 public:
  /// Throws std::invalid_argument unless `asked` names a scene's necklaces one after the other.
  BeadBlocks(PairsAsked asked, const BlockLoops<Dimension>& loops, BlockOrder order);

  [[nodiscard]] const PairsAsked& asked() const { return asked_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard]] BlockOrder order() const { return order_; }
  void arrange(BlockOrder order);

  /// Returns the origin and scale of the floats of the last scene.
  [[nodiscard]] const FloatConversion<Dimension>& conversion() const { return conversion_; }
  /// Sets the axes for the next scenes; none means the coordinate axes.
  void turn(const std::optional<Axes<Dimension>>& axes);

  /// Fills the blocks with a scene of the same number of balls. All other functions refer to this scene.
  /// Pairs at most `gap` apart count as near.
  void fill(const Balls<Dimension>& balls, double gap);
  /// Fills the beads of these blocks (ascending) again at their present positions. The caller then updates
  /// the nodes above by unite(). Returns false if the conversion cannot hold the beads; then all beads must
  /// be filled again.
  [[nodiscard]] bool fill_again(const Balls<Dimension>& balls, std::span<const std::uint32_t> blocks);
  /// Writes the box of a node of levels()[level] into its parent.
  void unite(std::size_t level, std::size_t node) {
    loops_.unite(levels_[level].data(), node, node + 1, levels_[level + 1].data());
  }
  /// Return upper bounds of the distance that a bead has moved since its block was last filled: the largest
  /// over all beads, and the largest of each block.
  [[nodiscard]] double strayed(const Balls<Dimension>& balls);
  [[nodiscard]] std::span<const double> strayed_by_block(const Balls<Dimension>& balls);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  /// Returns the blocks in the form that loops take.
  [[nodiscard]] Blocks<Dimension> view();
  /// Levels of nodes, from the nodes above blocks up to a single root.
  [[nodiscard]] const std::vector<std::vector<BlockNode<Dimension>>>& levels() const { return levels_; }
  [[nodiscard]] std::size_t beads_of(std::size_t block) const;
  [[nodiscard]] BeadId bead_at(std::uint32_t block, std::size_t lane) const {
    return order_ == BlockOrder::sequence ? first_bead_[block] + static_cast<BeadId>(lane)
                                          : sorted_[beads_in_block * block + lane];
  }
  /// Valid in sequence order only.
  [[nodiscard]] BeadId first_bead(std::size_t block) const { return first_bead_[block]; }
  /// The necklace of each block; 0 in spatial order.
  [[nodiscard]] const std::vector<std::uint32_t>& necklaces() const { return necklace_of_block_; }
  [[nodiscard]] bool equal_radii() const { return equal_; }
  /// Returns the greatest squared distance of beads of equal radii that counts as near.
  [[nodiscard]] float limit() const { return limit_; }
  /// Returns whether pairs near along the chain are searched separately and stretched blocks are left out.
  [[nodiscard]] bool goes_along() const {
    return order_ == BlockOrder::sequence && asked_.within && asked_.apart <= farthest_along;
  }
  /// One bit per block, for each node above blocks: neither the block alone nor the block with the next one
  /// has near pairs that are asked about.
  [[nodiscard]] const std::vector<std::uint16_t>& stretched() const { return stretched_; }

 private:
  [[nodiscard]] BlockExtent fill_floats(const Balls<Dimension>& balls, double gap);
  void find_stretched(std::size_t first, std::size_t last);
  void clear_lanes_behind(std::size_t block);
  [[nodiscard]] BlockSource<Dimension> source_of(double gap, double radius) const;
  /// Copies the beads bead(0) to bead(count - 1) into consecutive memory.
  template <class Bead>
  [[nodiscard]] BlockSource<Dimension> gather(const Balls<Dimension>& balls, BlockSource<Dimension> source,
                                              std::size_t count, const Bead& bead);
  [[nodiscard]] BlockSource<Dimension> turned_to_axes(BlockSource<Dimension> source, std::size_t lanes);
  /// Calls visit(source, first block, last block) with sources that cover all blocks.
  template <class Visit>
  void with_sources(const Balls<Dimension>& balls, BlockSource<Dimension> source, const Visit& visit);

  PairsAsked asked_;
  const BlockLoops<Dimension>& loops_;
  std::size_t beads_ = 0;
  BlockOrder order_ = BlockOrder::sequence;

  FloatConversion<Dimension> conversion_;
  bool equal_ = true;
  double gap_ = 0;
  float limit_ = 0;
  float least_ahead_ = 0;

  // The first bead of each block in sequence order, or all beads of the blocks in spatial order.
  std::vector<BeadId> first_bead_;
  std::vector<std::uint32_t> necklace_of_block_;
  MortonOrder<Dimension> morton_order_;
  std::vector<BeadId> sorted_;
  std::array<std::vector<float>, static_cast<std::size_t>(Dimension)> centers_;
  std::vector<float> radii_;
  std::vector<GroupBoxes<Dimension>> boxes_;
  std::vector<std::vector<BlockNode<Dimension>>> levels_;
  std::vector<std::uint16_t> stretched_;
  std::vector<double> strays_;
  std::array<std::vector<double>, static_cast<std::size_t>(Dimension) + 1> gathered_;
};

}  // namespace kds
