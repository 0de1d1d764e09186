#pragma once
// A combinatorial change of a structure. The event log holds changes, the fingerprint hashes them, and replay
// repeats a change from this record alone, without certificates.

#include <array>
#include <cstdint>

#include "motions/base/bead.h"

namespace kds {

struct Change {
  std::uint8_t kind = 0;         ///< index into the structure's kinds
  std::uint8_t size = 0;         ///< number of `ids` in use
  std::array<BeadId, 10> ids{};  ///< beads or nodes, as the structure documents for each kind

  friend bool operator==(const Change&, const Change&) = default;
};

}  // namespace kds
