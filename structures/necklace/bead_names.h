#pragma once
// Formats beads for messages.

#include <span>
#include <string>

#include "motions/base/bead.h"

namespace kds {

/// Returns for example "3, 7, infinity".
[[nodiscard]] inline std::string bead_names(std::span<const BeadId> beads) {
  std::string names;
  for (const BeadId b : beads) {
    if (!names.empty()) names += ", ";
    names += b == no_bead ? "infinity" : std::to_string(b);
  }
  return names;
}

}  // namespace kds
