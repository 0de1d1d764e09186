#pragma once
// Names of certificates: their types, and the functions they are about.

#include <array>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

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
  std::array<BeadId, most_beads> beads{};  ///< unused places hold the highest id

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

}  // namespace kds
