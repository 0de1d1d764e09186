#pragma once
// Beads are numbered along the scene: necklace after necklace, in sequence order, from 0.

#include <cstdint>

namespace kds {

using BeadId = std::uint32_t;

/// No bead of any scene: after all others in every order.
inline constexpr BeadId no_bead = 0xffffffffU;

}  // namespace kds
