#pragma once
// Groups of beads. A bead may be in several groups or in none.

#include <cstdint>
#include <vector>

namespace kds {

/// The groups of each bead: bit k is set if the bead is in group k.
using BeadGroups = std::vector<std::uint8_t>;

}  // namespace kds
