#pragma once
// Names of certificates: their types, and the functions they are about, which name beads in ascending order.

#include <array>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "motions/base/bead.h"

namespace kds {

/// A certificate type's name and number. There is no central list of types. Simultaneous failures are handled
/// in the order of numbers; numbers below 1000 are reserved for the framework. If two types in a run have
/// the same number, creating their tables throws (kds/certificate_table.h).
struct CertificateType {
  std::uint32_t number = 0;
  std::string_view name;
};

/// Names the function of a certificate among all functions of a run, whatever structure holds the
/// certificate. Certificates with the same identity have the same function up to a positive or negative
/// factor. For types with constants, CertificateTable::identity provides the identity, because it knows the
/// constants. Ties between failure times are broken by identity: type first, then beads.
struct Identity {
  static constexpr std::size_t most_beads = 8;

  std::uint32_t type = 0;
  std::array<BeadId, most_beads> beads{};  ///< unused entries hold the highest id

  friend constexpr auto operator<=>(const Identity&, const Identity&) = default;
};

/// Returns the identity of a certificate that keeps its beads in one fixed order.
template <std::size_t N>
[[nodiscard]] constexpr Identity identity_of(const CertificateType& type,
                                             const std::array<BeadId, N>& beads) {
  static_assert(N <= Identity::most_beads);
  Identity identity{type.number, {}};
  identity.beads.fill(no_bead);
  for (std::size_t i = 0; i < N; ++i) identity.beads[i] = beads[i];
  return identity;
}

template <class C>
concept HasCertificateType = requires {
  { C::type } -> std::same_as<const CertificateType&>;
};
template <class C>
concept HasIdentity = requires(const C& certificate) {
  { certificate.identity() } -> std::same_as<Identity>;
};
/// side() distinguishes a function from its negative, which has the same identity.
template <class C>
concept HasSide = requires(const C& certificate) {
  { certificate.side() } -> std::same_as<bool>;
};

/// The requirements common to all kinds of certificates.
template <class C>
concept NamedCertificate = HasCertificateType<C> && HasIdentity<C> && HasSide<C>;

// Sorts the beads of certificates whose function only changes sign when two beads are exchanged. The
// certificate keeps the sorted beads and the sign of the permutation, so all certificates over the same beads
// share one function, identical to the last bit.

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
