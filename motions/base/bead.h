#pragma once
// Identifiers of beads. Beads are numbered along the scene from 0: necklace after necklace, in sequence
// order.

#include <cstdint>

namespace kds {

using BeadId = std::uint32_t;

/// An id that belongs to no bead of any scene. This id sorts after all others.
inline constexpr BeadId no_bead = 0xffffffffU;

/// A run of consecutive beads.
struct BeadRange {
  BeadId first = 0;
  BeadId last = 0;  ///< inclusive

  friend bool operator==(const BeadRange&, const BeadRange&) = default;
};

}  // namespace kds
