#pragma once
// How certificates are named: their types, and the functions they are about.

#include <array>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "motions/base/bead.h"

namespace kds {

/// A certificate type's own name and number: no list holds them. Simultaneous failures are handled in the
/// order of numbers; those below 1000 are the framework's. Two types of one number in a run are refused when
/// their tables are made (kds/certificate_table.h).
struct CertificateType {
  std::uint32_t number = 0;
  std::string_view name;
};

/// Names the function of a certificate among all of a run, whatever structure holds it. Certificates with the
/// same identity have, up to a positive or negative factor, the same function; where a type has constants it
/// is CertificateTable::identity that tells, which knows them. Ties between failure times are
/// broken by it: type first, then beads.
struct Identity {
  static constexpr std::size_t most_beads = 8;

  std::uint32_t type = 0;
  std::array<BeadId, most_beads> beads{};  ///< unused places hold the highest id

  friend constexpr auto operator<=>(const Identity&, const Identity&) = default;
};

/// The identity of a certificate that keeps its beads in one order.
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
/// Differs between a function and its negative of one identity.
template <class C>
concept HasSide = requires(const C& certificate) {
  { certificate.side() } -> std::same_as<bool>;
};

/// What every certificate has, whatever its kind.
template <class C>
concept NamedCertificate = HasCertificateType<C> && HasIdentity<C> && HasSide<C>;

}  // namespace kds
