#pragma once
// Inserts beads into a basis and erases them, keeping its beads in order. The code has no branches, because
// they would be unpredictable.

#include <algorithm>

#include "structures/enclosing_sphere/basis.h"

namespace kds {

[[gnu::always_inline]] inline void erase_place(Basis& basis, std::size_t place) {
  for (std::size_t i = 0; i + 1 < Basis::max_size; ++i)
    basis.beads[i] = basis.beads[i + (i >= place ? 1U : 0U)];
  --basis.size;
}

/// The basis must have room for the bead.
[[gnu::always_inline]] inline void insert_bead(Basis& basis, BeadId bead) {
  auto& b = basis.beads;
  for (std::size_t i = 0; i < Basis::max_size; ++i) {  // insertion by compare and exchange
    const BeadId here = i < basis.size ? b[i] : no_bead;
    b[i] = std::min(here, bead);
    bead = std::max(here, bead);
  }
  ++basis.size;
}

}  // namespace kds
