#pragma once
// The certificates of membership (certificates/types/membership.h), a table for each type: equal radii first,
// by the size of the basis from 1 on.

#include "certificates/types/membership.h"
#include "kds/certificate_tables.h"
#include "structures/enclosing_sphere/basis.h"

namespace kds {

namespace detail {

template <Motion M, Kernel K, int Dimension, Radii radii>
struct TablesOfMembership;
template <Motion M, Kernel K>
struct TablesOfMembership<M, K, 2, Radii::equal> {
  using Type = CertificateTables<M, K, BeadInSphere<1>, BeadInSphere<2>, PowerTest<2>>;
};
template <Motion M, Kernel K>
struct TablesOfMembership<M, K, 3, Radii::equal> {
  using Type = CertificateTables<M, K, BeadInSphere<1>, BeadInSphere<2>, BeadInSphere<3>, PowerTest<3>>;
};
template <Motion M, Kernel K>
struct TablesOfMembership<M, K, 2, Radii::any> {
  using Type = CertificateTables<M, K, BeadInSphere<1>, BeadInSphere<2>, PowerTest<2>, BallInSphere<2, 1>,
                                 BallInSphere<2, 2>, BallInSphere<2, 3>>;
};
template <Motion M, Kernel K>
struct TablesOfMembership<M, K, 3, Radii::any> {
  using Type =
      CertificateTables<M, K, BeadInSphere<1>, BeadInSphere<2>, BeadInSphere<3>, PowerTest<3>,
                        BallInSphere<3, 1>, BallInSphere<3, 2>, BallInSphere<3, 3>, BallInSphere<3, 4>>;
};

}  // namespace detail

template <Motion M, Kernel K, Radii radii>
using MembershipTables = typename detail::TablesOfMembership<M, K, M::dimension, radii>::Type;

/// The bead that a certificate of a node with this basis is about.
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
