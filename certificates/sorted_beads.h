#pragma once
// Certificates whose function only changes sign when two beads trade places keep their beads sorted, with the
// sign of the permutation: then all certificates over the same beads share one function to the last bit.

#include <array>
#include <cstddef>

#include "motions/bead.h"

namespace kds {

/// Sorts ascending; 1 if an even number of exchanges did it, else -1.
template <std::size_t N>
[[nodiscard]] constexpr int sort_beads(std::array<BeadId, N>& beads) {
  // By rank, without branches: this runs for every certificate.
  std::array<unsigned, N> rank{};
  unsigned inversions = 0;
  for (std::size_t j = 1; j < N; ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const unsigned inverted = beads[j] < beads[i] ? 1 : 0;
      inversions += inverted;
      rank[i] += inverted;
      rank[j] += 1 - inverted;
    }
  }
  const std::array<BeadId, N> before = beads;
  for (std::size_t i = 0; i < N; ++i) beads[rank[i]] = before[i];
  return inversions % 2 == 0 ? 1 : -1;
}

}  // namespace kds
