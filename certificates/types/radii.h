#pragma once

#include <cstdint>

namespace kds {

/// The guarantee about the radii of a necklace.
enum class Radii : std::uint8_t {
  equal,  ///< equal radii and weights for all beads, so no certificate is radical
  any
};

}  // namespace kds
