#pragma once
// A run of consecutive beads.

#include "motions/base/bead.h"

namespace kds {

struct BeadRange {
  BeadId first = 0;
  BeadId last = 0;  ///< inclusive

  friend bool operator==(const BeadRange&, const BeadRange&) = default;
};

}  // namespace kds
