#pragma once
// Certificates whose function only changes sign when two beads trade places keep their beads sorted, with the
// sign of the permutation: then all certificates over the same beads share one function to the last bit.

#include <array>
#include <cstddef>
#include <utility>

#include "motions/bead.h"

namespace kds {

/// Sorts ascending; 1 if an even number of exchanges did it, else -1. Always the same exchanges, without
/// branches and, as it is not a loop, in registers: this runs for every certificate.
template <std::size_t N>
[[nodiscard, gnu::always_inline]] constexpr int sort_beads(std::array<BeadId, N>& beads) {
  unsigned exchanges = 0;
  const auto exchange = [&](BeadId& a, BeadId& b) {
    const BeadId low = b < a ? b : a, high = b < a ? a : b;
    exchanges += b < a ? 1 : 0;
    a = low;
    b = high;
  };
  const auto raise_greatest = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (exchange(beads[I], beads[I + 1]), ...);
  };
  [&]<std::size_t... Done>(std::index_sequence<Done...>) {
    (raise_greatest(std::make_index_sequence<N - 1 - Done>{}), ...);
  }
  (std::make_index_sequence<N - 1>{});
  return exchanges % 2 == 0 ? 1 : -1;
}

}  // namespace kds
