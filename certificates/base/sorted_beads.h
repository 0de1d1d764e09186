#pragma once
// Certificates whose function only changes sign when two beads trade places keep their beads sorted, with the
// sign of the permutation: then all certificates over the same beads share one function to the last bit.

#include <array>
#include <cstddef>
#include <utility>

#include "motions/base/bead.h"

namespace kds {

namespace detail {

// Always the same exchanges, without branches and, as they are not loops, in registers: these run for every
// certificate. Each counts the exchanges it made; their order matters, so they stand between commas.

[[gnu::always_inline]] constexpr unsigned put_in_order(BeadId& a, BeadId& b) {
  const BeadId low = b < a ? b : a, high = b < a ? a : b;
  const unsigned exchanged = b < a ? 1 : 0;
  a = low;
  b = high;
  return exchanged;
}

/// Moves the greatest of the first beads, one more than there are indices, to their end.
template <std::size_t N, std::size_t... I>
[[gnu::always_inline]] constexpr unsigned raise_greatest(std::array<BeadId, N>& beads,
                                                         std::index_sequence<I...>) {
  unsigned count = 0;
  ((count += put_in_order(beads[I], beads[I + 1])), ...);
  return count;
}

template <std::size_t N, std::size_t... Done>
[[gnu::always_inline]] constexpr unsigned raise_all(std::array<BeadId, N>& beads,
                                                    std::index_sequence<Done...>) {
  unsigned count = 0;
  ((count += raise_greatest(beads, std::make_index_sequence<N - 1 - Done>{})), ...);
  return count;
}

template <std::size_t N, std::size_t... I>
[[gnu::always_inline]] constexpr unsigned lower_last(std::array<BeadId, N>& beads,
                                                     std::index_sequence<I...>) {
  unsigned count = 0;
  ((count += put_in_order(beads[N - 2 - I], beads[N - 1 - I])), ...);
  return count;
}

[[nodiscard]] constexpr int sign_of_exchanges(unsigned count) { return 1 - 2 * static_cast<int>(count % 2); }

}  // namespace detail

/// Sorts ascending; 1 if an even number of exchanges did it, else -1.
template <std::size_t N>
[[nodiscard, gnu::always_inline]] constexpr int sort_beads(std::array<BeadId, N>& beads) {
  return detail::sign_of_exchanges(detail::raise_all(beads, std::make_index_sequence<N - 1>{}));
}

/// Sorts ascending where all but the last are so already; 1 or -1 likewise.
template <std::size_t N>
[[nodiscard, gnu::always_inline]] constexpr int sort_last_bead(std::array<BeadId, N>& beads) {
  return detail::sign_of_exchanges(detail::lower_last(beads, std::make_index_sequence<N - 1>{}));
}

}  // namespace kds
