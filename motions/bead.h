#pragma once
// Beads are numbered along the scene: necklace after necklace, in sequence order, from 0.

#include <cstdint>

namespace kds {

using BeadId = std::uint32_t;

}  // namespace kds
