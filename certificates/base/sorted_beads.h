#pragma once
// Sorts the beads of certificates whose function only changes sign when two beads are exchanged. The
// certificate keeps the sorted beads and the sign of the permutation, so all certificates over the same beads
// share one function, identical to the last bit.

#include <array>
#include <cstddef>
#include <utility>

#include "motions/base/bead.h"

namespace kds {

namespace detail {

// Sorting networks without branches and loops, so that the beads stay in registers: they run for every
// certificate. Each function returns the number of exchanges it made. The order of exchanges matters, so they
// are separated by comma operators.

[[gnu::always_inline]] constexpr unsigned put_in_order(BeadId& a, BeadId& b) {
  const BeadId low = b < a ? b : a, high = b < a ? a : b;
  const unsigned exchanged = b < a ? 1 : 0;
  a = low;
  b = high;
  return exchanged;
}

/// Moves the largest of the first sizeof...(I) + 1 beads to their end.
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

/// Sorts ascending. Returns 1 if the permutation is even, else -1.
template <std::size_t N>
[[nodiscard, gnu::always_inline]] constexpr int sort_beads(std::array<BeadId, N>& beads) {
  return detail::sign_of_exchanges(detail::raise_all(beads, std::make_index_sequence<N - 1>{}));
}

/// Sorts ascending, if all beads but the last are already sorted. Returns 1 if the permutation is even, else
/// -1.
template <std::size_t N>
[[nodiscard, gnu::always_inline]] constexpr int sort_last_bead(std::array<BeadId, N>& beads) {
  return detail::sign_of_exchanges(detail::lower_last(beads, std::make_index_sequence<N - 1>{}));
}

}  // namespace kds
