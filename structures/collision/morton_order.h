#pragma once
// Beads in the order in which a Morton curve meets them: near in this order is, mostly, near in space.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/base/bead.h"
#include "structures/blocks/float_frame.h"
#include "structures/necklace/balls.h"

namespace kds {

/// Keeps its memory from one sort to the next.
template <int Dimension>
class MortonOrder {
 public:
  /// `order` becomes all beads, by the cells that hold their centres, of about a fourth of a bead each, were
  /// they evenly spread; by number within a cell. Of a scene so small that cells cannot be told apart, by
  /// number.
  void sort(const Balls<Dimension>& balls, std::vector<BeadId>& order);

 private:
  void make_keys(const Balls<Dimension>& balls, int bits);
  void sort_keys(int key_bits);

  std::vector<std::uint64_t> keys_, more_keys_;  // the cell above, the bead in the 32 bits below
};

}  // namespace kds
