#pragma once
// Sorts beads along a Morton curve (Z-order). Beads near in this order are mostly near in space.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/base/bead.h"
#include "structures/blocks/float_frame.h"
#include "structures/necklace/balls.h"

namespace kds {

/// Reuses its memory from one sort to the next.
template <int Dimension>
class MortonOrder {
 public:
  /// Writes all beads to `order`, sorted by the cell that holds their centre, and by number within a cell. If
  /// the beads were evenly spread, a cell would hold about a fourth of a bead. If the scene is so small that
  /// cells cannot be told apart, beads are sorted by number.
  void sort(const Balls<Dimension>& balls, std::vector<BeadId>& order);

 private:
  void make_keys(const Balls<Dimension>& balls, int bits);
  void sort_keys(int key_bits);

  std::vector<std::uint64_t> keys_, more_keys_;  // cell in the upper bits, bead in the lower 32 bits
};

}  // namespace kds
