#pragma once
// The tables of membership certificates (certificates/types/membership.h), one for each type: equal radii
// first, by the size of the basis from 1 on, then unequal radii, then relaxed spheres.

#include <algorithm>

#include "certificates/search/ball_in_sphere_search.h"
#include "certificates/search/relaxed_ball_in_sphere_search.h"
#include "certificates/types/relaxed_membership.h"
#include "kds/certificate_tables.h"
#include "structures/enclosing_sphere/basis.h"

namespace kds {

namespace detail {

template <int Dimension>
struct TablesOfMembership;
template <>
struct TablesOfMembership<2> {
  using Type = CertificateTables<BeadInSphere<1>, BeadInSphere<2>, PowerTest<2>, BallInSphere<2, 1>,
                                 BallInSphere<2, 2>, BallInSphere<2, 3>, RelaxedBeadInSphere<2>,
                                 RelaxedBeadInSphere<3>, BallInSphere<2, 1, true>, BallInSphere<2, 2, true>,
                                 BallInSphere<2, 3, true>>;
};
template <>
struct TablesOfMembership<3> {
  using Type =
      CertificateTables<BeadInSphere<1>, BeadInSphere<2>, BeadInSphere<3>, PowerTest<3>, BallInSphere<3, 1>,
                        BallInSphere<3, 2>, BallInSphere<3, 3>, BallInSphere<3, 4>, RelaxedBeadInSphere<2>,
                        RelaxedBeadInSphere<3>, RelaxedBeadInSphere<4>, BallInSphere<3, 1, true>,
                        BallInSphere<3, 2, true>, BallInSphere<3, 3, true>, BallInSphere<3, 4, true>>;
};

}  // namespace detail

/// Tells whether a certificate belongs to a relaxed sphere. Only a relaxed hierarchy holds such certificates.
template <class Certificate>
inline constexpr bool is_relaxed = requires(const Certificate& c) {
  c.beads.relaxation;
};

/// The tables of unequal radii stay empty if radii are promised to be equal.
template <int Dimension>
using MembershipTables = typename detail::TablesOfMembership<Dimension>::Type;

/// Returns the subject of the certificate of a node with this basis.
template <class Certificate>
[[nodiscard]] BeadId bead_of(const Certificate& certificate, const Basis&) {
  return certificate.beads.back();
}
template <int Dimension>
[[nodiscard]] BeadId bead_of(const PowerTest<Dimension>& certificate, const Basis& basis) {
  return *std::find_if(certificate.beads.begin(), certificate.beads.end(),
                       [&](BeadId b) { return !basis.contains(b); });
}

}  // namespace kds
