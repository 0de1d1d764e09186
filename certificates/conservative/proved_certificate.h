#pragma once
// Certificates that are proved until some time and no further: conservative tests over enclosures, early and
// never late. What cannot be proved any more need not be wrong: the structure that holds it answers by
// refining (a cage pair is split, a node is opened), never by changing what it says.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "certificates/base/certificate_type.h"
#include "certificates/conservative/cage_cage.h"
#include "certificates/conservative/cage_in_cage.h"
#include "motions/curves/curves.h"

namespace kds {

/// `proved_until(curves, from)` is the largest time such that it is proved to hold from `from` on; `from`
/// itself where nothing is.
template <class C, int Dimension>
concept ProvedCertificate = requires(const C& certificate, const Curves<Dimension>& curves, double from) {
  { C::type } -> std::same_as<const CertificateType&>;
  { certificate.identity() } -> std::same_as<Identity>;
  { certificate.proved_until(curves, from) } -> std::same_as<double>;
};

/// The basis of a cage: one to four beads, ascending.
struct CageBasis {
  std::array<BeadId, 4> beads{no_bead, no_bead, no_bead, no_bead};
  std::uint8_t size = 0;

  CageBasis() = default;
  explicit CageBasis(std::span<const BeadId> basis) : size(static_cast<std::uint8_t>(basis.size())) {
    std::copy(basis.begin(), basis.end(), beads.begin());
  }
  [[nodiscard]] std::span<const BeadId> span() const { return std::span(beads).first(size); }
};

namespace detail {

[[nodiscard]] inline Identity identity_of_pair(const CertificateType& type, const CageBasis& a,
                                               const CageBasis& b) {
  std::array<BeadId, 8> beads{};
  std::copy(b.beads.begin(), b.beads.end(), std::copy(a.beads.begin(), a.beads.end(), beads.begin()));
  return identity_of(type, beads);
}

}  // namespace detail

/// The closed spheres of two cages are disjoint (cage_cage.h).
struct CagesApart {
  static constexpr CertificateType type{6, "cages_apart"};

  CageBasis a, b;

  [[nodiscard]] Identity identity() const { return detail::identity_of_pair(type, a, b); }
  template <int Dimension>
  [[nodiscard]] double proved_until(const Curves<Dimension>& curves, double from) const {
    return cages_disjoint_until(curves, a.span(), b.span(), from);
  }
};

/// The sphere of one cage lies inside that of another (cage_in_cage.h).
struct CageInCage {
  static constexpr CertificateType type{7, "cage_in_cage"};

  CageBasis inner, outer;

  [[nodiscard]] Identity identity() const { return detail::identity_of_pair(type, inner, outer); }
  template <int Dimension>
  [[nodiscard]] double proved_until(const Curves<Dimension>& curves, double from) const {
    return cage_in_cage_until(curves, inner.span(), outer.span(), from);
  }
};

static_assert(ProvedCertificate<CagesApart, 3> && ProvedCertificate<CageInCage, 3>);

}  // namespace kds
