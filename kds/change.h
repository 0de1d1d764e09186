#pragma once
// A combinatorial change of a structure: what the event log holds, what the fingerprint hashes, and all that
// a structure needs to make the change again without any certificate (replay).

#include <array>
#include <cstdint>

#include "motions/base/bead.h"

namespace kds {

struct Change {
  std::uint8_t kind = 0;         ///< place in the structure's kinds
  std::uint8_t size = 0;         ///< how many of `ids` are used
  std::array<BeadId, 10> ids{};  ///< beads or nodes, as the structure documents for each kind

  friend bool operator==(const Change&, const Change&) = default;
};

}  // namespace kds
