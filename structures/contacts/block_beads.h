#pragma once
// The balls of a step in floats, stored block by block for vector loads. Proves for pairs of beads of two
// blocks that they stay apart, or overlap, during the whole step. All other pairs are unclear, and their
// polynomial must decide.
//
// The first filter uses swept balls. Relative to a drift that all beads share, a bead's control points lie
// within some distance of a centre, and so does the bead at all times. The bead's ball therefore lies in a
// larger ball at rest. The loops of the block tree filter swept balls like balls at rest: first boxes around
// four balls each, then single balls.
//
// The second filter uses all control points of the remaining pairs. Let d_k be the differences of two beads'
// control points and R_k the sums of their radii. The beads' distance exceeds R during the whole step if all
// n.d_k > R_k |n| for some direction n, because their difference is a mean of the d_k with nonnegative
// weights. The distance is below R if all |d_k| < R_k, by the triangle inequality. The direction n is d_0
// plus the last d_k, which loses nothing if beads move little relative to each other.
//
// Error bound. Coordinates are taken relative to the middle of all boxes and scaled to [-1, 1] by a power of
// two. Let e = 2^-24. Rounded to float, a coordinate has an error of at most 1.01 e, and a difference of two
// another 2e: 4e in all, 7e as a vector.
//
// The direction n is exact as computed, whatever it approximates. |d| < 3.5, so the rounding of n.d is at
// most 4e times 3.5 |n|, and n.d - R |n| is known within 21e |n|. Each radius is enlarged (reduced for
// `inside`) by 2^-19 = 32e, so their sum has 64e to spare, and by a factor of 1 + 2^-20 (1 - 2^-20). The
// factor covers the roundings of products, of sums of radii and of squares, 8e relatively. Squares are
// compared only if n.d > 2^-40; then |n| > 2^-42, and nothing underflows.
//
// For swept balls, drift and centre are exact as computed. The computed distance of a control point from its
// centre has an error of at most 12.3e, for which 16e are added. Another factor of 1 + 2^-20 covers the
// roundings of squares and root. The difference of two centres has an error of at most 7e, which the 64e
// cover. All these numbers are finite, so a pair that the loops of the block tree do not report as near is
// far. NaN occurs only in lanes without a bead.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/curves.h"
#include "structures/blocks/block_loops.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Cuts necklaces into runs of sixteen consecutive beads, fewer at a necklace's end. These runs are the cages
/// at the bottom of a family, because consecutive beads of a necklace stay near each other.
struct BeadBlock {
  static constexpr std::size_t most_beads = 16;

  BeadId first = 0;
  std::uint32_t count = 0;
  std::uint32_t necklace = 0;

  /// Returns a mask with one bit per bead.
  [[nodiscard]] std::uint32_t bits() const { return (1U << count) - 1U; }
};

/// Returns the runs in the order of the beads.
[[nodiscard]] inline std::vector<BeadBlock> blocks_of(std::span<const BeadRange> necklaces) {
  std::vector<BeadBlock> blocks;
  for (std::uint32_t necklace = 0; necklace < necklaces.size(); ++necklace) {
    const BeadRange& range = necklaces[necklace];
    for (std::size_t first = range.first; first <= range.last; first += BeadBlock::most_beads) {
      const std::size_t count = std::min(BeadBlock::most_beads, range.last + 1 - first);
      blocks.push_back({static_cast<BeadId>(first), static_cast<std::uint32_t>(count), necklace});
    }
  }
  return blocks;
}

/// Two blocks, given by their indices. The second does not come before the first.
struct BlockPair {
  std::uint32_t first, second;
};

/// Pairs of beads that are not proved apart.
struct PairsOfBlocks {
  std::vector<BeadPair> unclear;
  std::vector<BeadPair> overlapping;  ///< during the whole step; filled only on request
  std::uint64_t proved_apart = 0;     ///< pairs of groups of four beads whose boxes meet

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

  /// Takes the positions of the beads in this step. `middle` is the middle of all moving boxes and `half` is
  /// half their longest side. Both arguments may have any precision, and `half` may be infinite.
  void move_to(const Curves<Dimension>& curves, const std::array<double, Dimension>& middle, double half);

  /// Tests the pairs of beads of two blocks, or of one block with itself, that are at least `apart` beads
  /// apart along a chain. Adds to `pairs`.
  void look_at(std::span<const BlockPair> blocks, BeadId apart, bool list_overlapping, PairsOfBlocks& pairs);
  /// Behaves from now on as on a processor without long vectors. For tests.
  void use_short_vectors() { target_ = VectorTarget::plain; }

 private:
  /// Computes swept balls and the boxes around them.
  [[nodiscard]] Blocks<Dimension> swept();
  void find_drift(const Curves<Dimension>& curves, double scale);
  void set_radii(const Curves<Dimension>& curves, double scale);
  void look_at_all(const BeadBlock& a, const BeadBlock& b, BeadId apart, PairsOfBlocks& pairs) const;

  std::span<const BeadBlock> blocks_;
  std::size_t controls_;  // control points per curve
  std::size_t stride_;    // floats per block
  std::vector<float> floats_;
  std::vector<float> drift_;  // per control point
  std::vector<double> radii_;
  double scale_of_radii_ = 0;
  std::array<std::vector<float>, static_cast<std::size_t>(Dimension)> centers_;  // swept balls' centres
  std::vector<float> reaches_;                                                   // radii of swept balls
  std::vector<GroupBoxes<Dimension>> boxes_;
  std::vector<std::uint32_t> necklaces_;  // for each block
  VectorTarget target_ = widest_vector_target();
  bool usable_ = false;  // false if lengths are too large or too small for floats
};

}  // namespace kds
