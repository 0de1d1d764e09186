#pragma once
// The beads of a scene in blocks of 16, in float, with boxes of four beads each and nodes of 16 blocks, 16
// nodes and so on above them: what a BlockTree searches. In sequence a block holds beads that follow each
// other along one necklace, the last of a necklace maybe fewer; in spatial order beads that do along a Morton
// curve. Lanes without a bead are NaN, which is near nothing.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "structures/blocks/block_kernels.h"
#include "structures/blocks/float_frame.h"
#include "structures/collision/morton_order.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

enum class BlockOrder { sequence, spatial };

template <int Dimension>
class BeadBlocks {
 public:
  /// Throws std::invalid_argument where `asked` does not name a scene's necklaces one after the other.
  BeadBlocks(PairsAsked asked, const BlockKernels<Dimension>& kernels, BlockOrder order);

  [[nodiscard]] const PairsAsked& asked() const { return asked_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard]] BlockOrder order() const { return order_; }
  void arrange(BlockOrder order);

  /// The place and scale at which floats hold the last scene.
  [[nodiscard]] const FloatFrame<Dimension>& frame() const { return frame_; }
  /// The next scenes are filled in along these axes, or the coordinates'.
  void turn(const std::optional<Axes<Dimension>>& axes);

  /// A scene of as many balls: all that follows is about it, and pairs at most `gap` apart are near.
  void fill(const Balls<Dimension>& balls, double gap);
  /// The beads of these blocks (ascending) are now here; what is above them, unite() takes in. False where
  /// the frame does not hold them, and then all must be filled anew.
  [[nodiscard]] bool fill_again(const Balls<Dimension>& balls, std::span<const std::uint32_t> blocks);
  /// Makes the box of a node of levels()[level] known to the node above it.
  void unite(std::size_t level, std::size_t node) {
    kernels_.unite(levels_[level].data(), node, node + 1, levels_[level + 1].data());
  }
  /// How far a bead is at most from where it was filled in, rounded up; and the same of each block's beads.
  [[nodiscard]] double strayed(const Balls<Dimension>& balls);
  [[nodiscard]] std::span<const double> strayed_by_block(const Balls<Dimension>& balls);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  /// For kernels.
  [[nodiscard]] Blocks<Dimension> view();
  /// From the nodes above blocks up to one root.
  [[nodiscard]] const std::vector<std::vector<BlockNode<Dimension>>>& levels() const { return levels_; }
  [[nodiscard]] std::size_t beads_of(std::size_t block) const;
  [[nodiscard]] BeadId bead_at(std::uint32_t block, std::size_t lane) const {
    return order_ == BlockOrder::sequence ? first_bead_[block] + static_cast<BeadId>(lane)
                                          : sorted_[beads_in_block * block + lane];
  }
  /// In sequence only.
  [[nodiscard]] BeadId first_bead(std::size_t block) const { return first_bead_[block]; }
  /// Of each block; 0 in spatial order.
  [[nodiscard]] const std::vector<std::uint32_t>& necklaces() const { return necklace_of_block_; }
  [[nodiscard]] bool equal_radii() const { return equal_; }
  /// The greatest square of a distance of beads of equal radii that is near.
  [[nodiscard]] float limit() const { return limit_; }
  /// Whether pairs near along the chain are looked for in a row, and stretched blocks left out.
  [[nodiscard]] bool goes_along() const {
    return order_ == BlockOrder::sequence && asked_.within && asked_.apart <= farthest_along;
  }
  /// Of each node above blocks, a bit a block: no near pairs that are asked about in it and with the next.
  [[nodiscard]] const std::vector<std::uint16_t>& stretched() const { return stretched_; }

 private:
  [[nodiscard]] BlockExtent fill_in_frame(const Balls<Dimension>& balls, double gap);
  void find_stretched(std::size_t first, std::size_t last);
  void clear_lanes_behind(std::size_t block);
  [[nodiscard]] BlockSource<Dimension> source_of(double gap, double radius) const;
  /// The beads bead(0) to bead(count - 1), copied one after the other.
  template <class Bead>
  [[nodiscard]] BlockSource<Dimension> gather(const Balls<Dimension>& balls, BlockSource<Dimension> source,
                                              std::size_t count, const Bead& bead);
  [[nodiscard]] BlockSource<Dimension> placed(BlockSource<Dimension> source, std::size_t lanes);
  /// Calls visit(source, first block, last block) with sources for all blocks.
  template <class Visit>
  void with_sources(const Balls<Dimension>& balls, BlockSource<Dimension> source, const Visit& visit);

  PairsAsked asked_;
  const BlockKernels<Dimension>& kernels_;
  std::size_t beads_ = 0;
  BlockOrder order_ = BlockOrder::sequence;

  FloatFrame<Dimension> frame_;
  bool equal_ = true;
  double gap_ = 0;
  float limit_ = 0;
  float least_ahead_ = 0;

  // The blocks' first beads in sequence, or all their beads in spatial order.
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
