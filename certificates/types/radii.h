#pragma once

#include <cstdint>

namespace kds {

/// What is promised of the radii of a necklace.
enum class Radii : std::uint8_t {
  equal,  ///< the same for all beads, and so are weights: no certificate is radical
  any
};

}  // namespace kds
