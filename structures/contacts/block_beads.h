#pragma once
// The balls of a step in floats, block by block and side by side, and which pairs of two blocks are proved
// apart, or overlapping, all over the step. What is neither is not known: its polynomial must tell.
//
// First by swept balls: relative to a drift that all beads share, a bead's control points lie within some
// distance of a centre, and so does the bead at all times; its ball lies in a larger one that rests. Those
// are sifted as balls at rest are, by the loops of the block tree: boxes around four each, then one by one.
// What they leave over, by all control points: let d_k be the differences of two beads' control points and
// R_k the sums of their radii. The beads' distance exceeds R all over the step if for some direction n all
// n.d_k > R_k |n|, as their difference is a mean of the d_k with weights that are never negative. It is below
// R if all |d_k| < R_k, by the triangle inequality. The direction taken is d_0 plus the last d_k: where beads
// move little relative to each other it loses nothing.
//
// The bound of the errors. Coordinates are taken relative to the middle of all boxes and brought to [-1, 1]
// by a power of two; let e = 2^-24. As a float one errs by at most 1.01 e, a difference of two by another 2e:
// 4e in all, 7e as a vector. n is a direction as it stands, whatever it was meant to be. |d| < 3.5, so n.d is
// rounded by at most 4e times 3.5 |n|, and n.d - R |n| is known within 21e |n|. Radii are made larger (for
// `inside`, smaller) by 2^-19 = 32e each, so that their sums have 64e to spare, and by a factor of 1 + 2^-20
// (1 - 2^-20), which is for the roundings of products and sums of radii and of squares, 8e relatively.
// Squares are compared where n.d > 2^-40: then |n| > 2^-42, and nothing underflows. Of swept balls drift and
// centre are what they are; how far a control point strays errs by at most 12.3e, for which 16e are added,
// and by roundings of squares and root, for which there is another factor of 1 + 2^-20; the difference of two
// centres errs by 7e, which the 64e cover. All of them are finite, so that what the loops of the block tree
// do not find near is far; only where a block has no bead there is NaN.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/blocks/block_kernels.h"
#include "structures/blocks/vector_target.h"
#include "structures/collision/pairs_asked.h"
#include "structures/contacts/bead_blocks.h"

namespace kds {

/// Two blocks, by their places; the second does not lie before the first.
struct BlockPair {
  std::uint32_t first, second;
};

/// Pairs of beads that are not proved apart.
struct PairsOfBlocks {
  std::vector<BeadPair> unclear;
  std::vector<BeadPair> overlapping;  ///< all over the step; only where they are asked for
  std::uint64_t proved_apart = 0;     ///< pairs of four beads and four, whose boxes meet

  void clear() {
    unclear.clear();
    overlapping.clear();
    proved_apart = 0;
  }
};

template <int Dimension>
class BlockBeads {
 public:
  explicit BlockBeads(std::span<const BeadBlock> blocks, int degree);

  /// Where the beads are in this step. The middle and half the longest side of all that moves, both of any
  /// precision: half may be infinite.
  void move_to(const Curves<Dimension>& curves, const std::array<double, Dimension>& middle, double half);

  /// Of pairs of beads of two blocks, or of one with itself, those at least `apart` beads apart along a
  /// chain. Adds to `pairs`.
  void look_at(std::span<const BlockPair> blocks, BeadId apart, bool list_overlapping, PairsOfBlocks& pairs);
  /// From now on as on processors without long vectors, for tests.
  void use_short_vectors() { target_ = VectorTarget::plain; }

 private:
  /// Swept balls, and boxes around them.
  [[nodiscard]] Blocks<Dimension> swept();
  void find_drift(const Curves<Dimension>& curves, double scale);
  void set_radii(const Curves<Dimension>& curves, double scale);
  void look_at_all(const BeadBlock& a, const BeadBlock& b, BeadId apart, PairsOfBlocks& pairs) const;

  std::span<const BeadBlock> blocks_;
  std::size_t controls_;  // a curve
  std::size_t stride_;    // of a block, in floats
  std::vector<float> floats_;
  std::vector<float> drift_;  // of each control point
  std::vector<double> radii_;
  double scale_of_radii_ = 0;
  std::array<std::vector<float>, static_cast<std::size_t>(Dimension)> centers_;  // of swept balls
  std::vector<float> reaches_;                                                   // their radii
  std::vector<GroupBoxes<Dimension>> boxes_;
  std::vector<std::uint32_t> necklaces_;  // of blocks
  VectorTarget target_ = widest_vector_target();
  bool usable_ = false;  // floats: else lengths are too large or too small for them
};

}  // namespace kds
