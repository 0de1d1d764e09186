#pragma once
// Blocks of 16 consecutive beads in float, and a tree over them, 16 children a node, in sequence order: what
// the inner loops of the block tree (block_tree.h) work on, and these loops, once for each vector target. All
// give the same bits. What is called a box is the box of float balls (float_frame.h).

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "structures/blocks/vector_target.h"

namespace kds {

inline constexpr std::size_t beads_in_block = 16;
inline constexpr std::size_t children_of_node = 16;
/// So many, at most, are compared in one call: their scratch stays in the first cache.
inline constexpr std::size_t block_pairs_at_once = 256;
/// Behind the last number that a kernel writes there must be room for so many more.
inline constexpr std::size_t kernel_padding = 16;

/// Boxes of four consecutive beads each.
template <int Dimension>
struct alignas(32) GroupBoxes {
  std::array<std::array<float, 4>, static_cast<std::size_t>(Dimension)> low, high;
};
/// 16 numbers of each kind a block. Lanes without a bead, and 16 behind the last block, have centres that are
/// NaN, which is near nothing; the boxes do not know of them.
template <int Dimension>
struct Blocks {
  std::array<float*, static_cast<std::size_t>(Dimension)> centers;
  float* radii;  ///< float radii; not looked at where all are equal
  GroupBoxes<Dimension>* boxes;
};

/// The boxes of its children; one that does not exist meets nothing.
template <int Dimension>
struct alignas(64) BlockNode {
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  std::array<std::array<float, children_of_node>, dimension> low, high;

  BlockNode() {
    for (auto& axis : low) axis.fill(std::numeric_limits<float>::infinity());
    for (auto& axis : high) axis.fill(-std::numeric_limits<float>::infinity());
  }
};

/// Doubles of consecutive beads and how they become floats.
template <int Dimension>
struct BlockSource {
  std::array<const double*, static_cast<std::size_t>(Dimension)> centers;
  const double* radii;
  std::array<double, static_cast<std::size_t>(Dimension)> shift;
  double scale;
  double radius_factor, radius_added;  ///< float radius = radius times factor plus added
  float radius;                        ///< of all, where they are equal
};

/// The largest numbers that came out.
struct BlockExtent {
  float coordinate = 0, radius = 0;
};

/// Pairs of nodes or blocks by their numbers.
struct NodePairs {
  std::uint32_t* first;
  std::uint32_t* second;
};

/// Which lanes of two blocks are pairs asked about.
struct LanesAsked {
  const std::uint32_t* necklace_of_block;
  std::uint32_t apart;
  bool within, between;
  bool along_done;  ///< beads of one group, or of a group and the next, have been compared already
};
inline constexpr std::uint32_t farthest_along = 7;  // between beads of two groups in a row

/// Four beads of one block and four of another, some of which are near: pair p of those looked at, group g of
/// the first and h of the second as 16 p + 4 g + h; bit 4 i + j for bead i of g and j of h.
struct NearGroups {
  std::uint32_t* groups;
  std::uint16_t* beads;
};

template <int Dimension>
struct BlockKernels {
  /// Blocks first .. last - 1 from 16 beads each, and their boxes into the nodes above. The source starts at
  /// the first bead of block `first`.
  using Fill = BlockExtent (*)(const BlockSource<Dimension>& source, std::size_t first, std::size_t last,
                               const Blocks<Dimension>& blocks, BlockNode<Dimension>* parents);
  /// The greatest square of how far a centre of these blocks is from where it was.
  using Stray = float (*)(const BlockSource<Dimension>& source, std::size_t first, std::size_t last,
                          const Blocks<Dimension>& before);
  /// The boxes of nodes first .. last - 1 into those above.
  using Unite = void (*)(const BlockNode<Dimension>* nodes, std::size_t first, std::size_t last,
                         BlockNode<Dimension>* parents);
  /// Whether each bead of these blocks and of the one behind each, to its last, lies ahead of the bead before
  /// it by more than `least` in one direction: bit k of number n for block 16 n + k.
  using Stretch = void (*)(const Blocks<Dimension>& blocks, std::size_t first, std::size_t last, float least,
                           std::uint16_t* stretched);
  /// The pairs of children that meet, one of node a and one of node b (a == b: each pair once, a child with
  /// itself too, but children of bits in `stretched` neither with themselves nor with the next), appended;
  /// returns how many.
  using Expand = std::size_t (*)(const BlockNode<Dimension>* nodes, std::uint32_t a, std::uint32_t b,
                                 unsigned stretched, NodePairs found);
  /// Near beads of `count` pairs of blocks; `limit`: the greatest square of a distance that is near, where
  /// radii are equal. `groups`: scratch for 16 numbers a pair. `tests` counts the groups of four that were
  /// looked at. Returns how many were found.
  using Compare = std::size_t (*)(const Blocks<Dimension>& blocks, const NodePairs& pairs, std::size_t count,
                                  const LanesAsked& asked, float limit, std::uint32_t* groups,
                                  const NearGroups& found, std::uint64_t& tests);
  /// Near beads from `apart` to farthest_along apart in sequence, of blocks first .. last - 1 that are not
  /// stretched, and what follows them: 8 block + how far apart, and a bit for the first bead of each pair.
  /// Room for 8 a block.
  using CompareAlong = std::size_t (*)(const Blocks<Dimension>& blocks, std::size_t first, std::size_t last,
                                       const std::uint16_t* stretched, std::uint32_t apart, float limit,
                                       const NearGroups& found);
  Fill fill_equal, fill_unequal;
  Stray stray;
  Unite unite;
  Stretch stretch;
  Expand expand;
  Compare compare_equal, compare_unequal;
  CompareAlong along_equal, along_unequal;
};

/// The target must be available.
template <int Dimension>
[[nodiscard]] const BlockKernels<Dimension>& block_kernels(VectorTarget target);

namespace detail {

/// One a target, in files of their own; null where the build has no such instructions.
template <int Dimension>
[[nodiscard]] const BlockKernels<Dimension>* plain_block_kernels();
template <int Dimension>
[[nodiscard]] const BlockKernels<Dimension>* avx2_block_kernels();
template <int Dimension>
[[nodiscard]] const BlockKernels<Dimension>* avx512_block_kernels();

}  // namespace detail

}  // namespace kds
