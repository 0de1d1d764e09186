#pragma once
// Certificates whose function only changes sign when two beads trade places keep their beads sorted, with the
// sign of the permutation: then all certificates over the same beads share one function to the last bit.

#include <array>
#include <cstddef>
#include <utility>

#include "motions/bead.h"

namespace kds {

/// Sorts ascending; 1 if an even number of exchanges did it, else -1.
template <std::size_t N>
[[nodiscard]] constexpr int sort_beads(std::array<BeadId, N>& beads) {
  int sign = 1;
  for (std::size_t i = 1; i < N; ++i) {
    for (std::size_t j = i; j > 0 && beads[j] < beads[j - 1]; --j) {
      std::swap(beads[j], beads[j - 1]);
      sign = -sign;
    }
  }
  return sign;
}

}  // namespace kds
