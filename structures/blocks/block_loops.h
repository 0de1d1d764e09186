#pragma once
// Declares blocks of 16 consecutive beads in float, a tree over these blocks in sequence order (16 children
// per node, a linear BVH), and the inner loops that work on them. The block tree (block_tree.h) calls the
// loops. These loops are compiled once per vector target, and every target gives the same bits. A "box" here
// is the axis-aligned box of float balls (float_conversion.h).

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace kds {

/// Selects the vector instructions of collision detection's inner loops. The choice is made when a detector
/// is constructed. All targets give the same results.
enum class VectorTarget { plain, avx2, avx512 };
/// Names of the targets, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> vector_target_names{"plain", "AVX2", "AVX-512"};

/// Returns whether both this processor and this build support the target.
[[nodiscard]] bool is_available(VectorTarget target);
[[nodiscard]] VectorTarget widest_vector_target();

inline constexpr std::size_t beads_in_block = 16;
inline constexpr std::size_t children_of_node = 16;
/// Maximum number of block pairs compared in one call. With this limit the scratch memory stays in the
/// first-level cache.
inline constexpr std::size_t block_pairs_at_once = 256;
/// Number of elements that must be allocated beyond the last number a loop writes.
inline constexpr std::size_t loop_padding = 16;

/// Boxes of four groups, each a group of four consecutive beads.
template <int Dimension>
struct alignas(32) GroupBoxes {
  std::array<std::array<float, 4>, static_cast<std::size_t>(Dimension)> low, high;
};
/// Arrays with 16 numbers of each kind per block. Lanes without a bead, and 16 lanes after the last block,
/// have NaN as centre. NaN is near nothing. The boxes ignore lanes without a bead.
template <int Dimension>
struct Blocks {
  std::array<float*, static_cast<std::size_t>(Dimension)> centers;
  float* radii;  ///< float radii; unused if all radii are equal
  GroupBoxes<Dimension>* boxes;
};

/// The boxes of a node's children. The box of a missing child meets nothing.
template <int Dimension>
struct alignas(64) BlockNode {
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  std::array<std::array<float, children_of_node>, dimension> low, high;

  BlockNode() {
    for (auto& axis : low) axis.fill(std::numeric_limits<float>::infinity());
    for (auto& axis : high) axis.fill(-std::numeric_limits<float>::infinity());
  }
};

/// Doubles of consecutive beads and the map from these doubles to floats.
template <int Dimension>
struct BlockSource {
  std::array<const double*, static_cast<std::size_t>(Dimension)> centers;
  const double* radii;
  std::array<double, static_cast<std::size_t>(Dimension)> shift;
  double scale;
  double radius_factor, radius_added;  ///< float radius = radius * radius_factor + radius_added
  float radius;                        ///< the common radius, if all radii are equal
};

/// The largest coordinate (in absolute value) and the largest radius that a loop wrote.
struct BlockExtent {
  float coordinate = 0, radius = 0;
};

/// Pairs of nodes or of blocks, given by their numbers.
struct NodePairs {
  std::uint32_t* first;
  std::uint32_t* second;
};

/// Tells which lanes of two blocks form pairs that the query asks about.
struct LanesAsked {
  const std::uint32_t* necklace_of_block;
  std::uint32_t apart;
  bool within, between;
  bool along_done;  ///< beads of one group, or of two consecutive groups, have been compared already
};
inline constexpr std::uint32_t farthest_along = 7;  // for beads of two consecutive groups

/// Groups with near beads: four beads of one block and four of another. `groups` holds 16 p + 4 g + h for
/// compared pair p, group g of the first block and group h of the second. Bit 4 i + j of `beads` stands for
/// bead i of group g and bead j of group h.
struct NearGroups {
  std::uint32_t* groups;
  std::uint16_t* beads;
};

template <int Dimension>
struct BlockLoops {
  /// Fills blocks first .. last - 1 from 16 beads each and writes their boxes into the parent nodes. The
  /// source starts at the first bead of block `first`.
  using Fill = BlockExtent (*)(const BlockSource<Dimension>& source, std::size_t first, std::size_t last,
                               const Blocks<Dimension>& blocks, BlockNode<Dimension>* parents);
  /// Returns the greatest squared distance between a centre of these blocks and its previous position.
  using Stray = float (*)(const BlockSource<Dimension>& source, std::size_t first, std::size_t last,
                          const Blocks<Dimension>& before);
  /// Writes the boxes of nodes first .. last - 1 into their parents.
  using Unite = void (*)(const BlockNode<Dimension>* nodes, std::size_t first, std::size_t last,
                         BlockNode<Dimension>* parents);
  /// Tells for each block b whether its chain is stretched: each bead of block b and of block b + 1, up to
  /// the last, lies ahead of the bead before it by more than `least` in one direction. Bit k of number n
  /// belongs to block 16 n + k.
  using Stretch = void (*)(const Blocks<Dimension>& blocks, std::size_t first, std::size_t last, float least,
                           std::uint16_t* stretched);
  /// Appends the pairs of children that meet, one child of node a and one of node b, and returns their
  /// number. If a == b, each pair comes once, and a child is also paired with itself. A child whose bit in
  /// `stretched` is set is paired neither with itself nor with the next child.
  using Expand = std::size_t (*)(const BlockNode<Dimension>* nodes, std::uint32_t a, std::uint32_t b,
                                 unsigned stretched, NodePairs found);
  /// Finds near beads of `count` pairs of blocks and returns the number of groups found. `limit` is the
  /// greatest squared distance that counts as near if radii are equal. `groups` is scratch memory for 16
  /// numbers per pair. `tests` counts the groups of four that were compared.
  using Compare = std::size_t (*)(const Blocks<Dimension>& blocks, const NodePairs& pairs, std::size_t count,
                                  const LanesAsked& asked, float limit, std::uint32_t* groups,
                                  const NearGroups& found, std::uint64_t& tests);
  /// Finds near beads that are `apart` to farthest_along apart in sequence. The first bead lies in one of the
  /// blocks first .. last - 1 that is not stretched, the second may lie in the next block. Each result is 8
  /// block + distance in sequence, with one bit for the first bead of each pair. `found` needs room for 8
  /// results per block.
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

/// Returns the loops of `target`, which must be available.
template <int Dimension>
[[nodiscard]] const BlockLoops<Dimension>& block_loops(VectorTarget target);

namespace detail {

/// Returns the loops of one target, each defined in a file of its own. Null if the build lacks these
/// instructions.
template <int Dimension>
[[nodiscard]] const BlockLoops<Dimension>* avx2_block_loops();
template <int Dimension>
[[nodiscard]] const BlockLoops<Dimension>* avx512_block_loops();

}  // namespace detail

}  // namespace kds
