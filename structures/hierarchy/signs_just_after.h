#pragma once
// Decides by certificates which bead lies in which sphere just after the present time (SphereSigns of
// basis.h), and repairs the basis of a node with these signs. While a failure is handled, the sign of its
// certificate is known, and so is the sign of its function in other certificates.

#include <algorithm>
#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "certificates/base/radical.h"
#include "certificates/search/sphere_searches.h"
#include "certificates/types/membership.h"
#include "certificates/types/orientation.h"
#include "kds/certificate_tables.h"
#include "kds/simulator.h"
#include "motions/curves/curves.h"
#include "motions/curves/motion_ref.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/hierarchy/node_proofs.h"

namespace kds {

/// Decides by certificates which bead lies in which sphere (SphereSigns of basis.h). `sign(certificate)`
/// returns 1, 0 or -1 for any membership or orientation certificate.
template <int Dimension, class Sign>
class MembershipSigns {
 public:
  static constexpr int dimension = Dimension;

  MembershipSigns(const Curves<Dimension>& curves, Radii radii, Sign sign)
      : curves_(curves), radii_(radii), sign_(std::move(sign)) {}

  [[nodiscard]] int membership(const Basis& basis, BeadId bead, bool inside, int orientation) const {
    return visit_membership(radii_, curves_, std::span(basis.begin(), basis.end()), bead, inside, orientation,
                            sign_);
  }
  [[nodiscard]] int orientation(const Basis& basis) const {
    Orientation<dimension> certificate;
    std::copy_n(basis.begin(), dimension + 1, certificate.beads.begin());
    return sign_(certificate);
  }

 private:
  Curves<Dimension> curves_;
  Radii radii_;
  Sign sign_;
};

namespace detail {

template <int Dimension>
struct TablesOfMembership;
template <>
struct TablesOfMembership<2> {
  using Type = CertificateTables<BeadInSphere<1>, BeadInSphere<2>, PowerTest<2>, BallInSphere<2, 1>,
                                 BallInSphere<2, 2>, BallInSphere<2, 3>>;
};
template <>
struct TablesOfMembership<3> {
  using Type =
      CertificateTables<BeadInSphere<1>, BeadInSphere<2>, BeadInSphere<3>, PowerTest<3>, BallInSphere<3, 1>,
                        BallInSphere<3, 2>, BallInSphere<3, 3>, BallInSphere<3, 4>>;
};

}  // namespace detail

/// The tables of membership certificates (certificates/types/membership.h), one for each type: equal radii
/// first, by the size of the basis from 1 on, then unequal radii. The tables of unequal
/// radii stay empty if radii are promised to be equal.
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

/// The certificate that fails now.
template <int Dimension>
struct PresentFailure {
  using OfFull = BallInSphere<Dimension, Dimension + 1>;

  Identity identity;
  bool side = true;  ///< the side of zero that its certificate requires
  /// The failing certificate, if it belongs to a full basis and a ball that reached its sphere. All
  /// certificates of these balls have the same norm (ball_in_sphere.h).
  std::optional<OfFull> of_full;

  template <class Certificate>
  explicit PresentFailure(const Certificate& failed) : identity(failed.identity()), side(failed.side()) {
    if constexpr (std::same_as<Certificate, OfFull>) of_full = failed;
  }

  template <class Certificate>
  [[nodiscard]] bool is_of(const Certificate& certificate) const {
    return certificate.identity() == identity;
  }
  /// Returns whether a certificate with another function has the present root too.
  template <class Certificate>
  [[nodiscard]] bool shares_root_with(const Certificate& certificate) const {
    if constexpr (std::same_as<Certificate, OfFull>)
      return of_full && ascending(*of_full) == ascending(certificate);
    return false;
  }

 private:
  [[nodiscard]] static auto ascending(const OfFull& c) {
    auto beads = c.beads;
    for (std::size_t i = beads.size() - 1; i > 0 && beads[i] < beads[i - 1]; --i)
      std::swap(beads[i], beads[i - 1]);
    return beads;  // the basis was ascending
  }
};

template <int Dimension>
class SignsJustAfter {
 public:
  static constexpr int dimension = Dimension;

  /// `curves` are those of the present step.
  SignsJustAfter(const Simulator& simulator, const MotionRef<Dimension>& motion,
                 const Curves<Dimension>& curves, Radii radii, MembershipTables<Dimension>& tables,
                 StageCounts& stages)
      : simulator_(simulator),
        curves_(curves),
        radii_(radii),
        tables_(tables),
        orientations_(search_over<Orientation<Dimension>>(motion)),
        stages_(stages) {}

  [[nodiscard]] int membership(const Basis& basis, BeadId bead, bool inside, int orientation) const;
  [[nodiscard]] int orientation(const Basis& basis) const;

  /// Set while the failure is handled.
  std::optional<PresentFailure<Dimension>> present;

 private:
  struct Sign;

  const Simulator& simulator_;
  const Curves<Dimension>& curves_;
  Radii radii_;
  MembershipTables<Dimension>& tables_;
  std::unique_ptr<CertificateSearch<Orientation<Dimension>>> orientations_;
  StageCounts& stages_;
};

/// Finds the next basis of a node of a wrapped hierarchy when one of its certificates has failed. Uses proofs
/// from the sphere's path or, if they do not decide, the signs just after the event.
template <int Dimension>
class BasisRepair {
 public:
  BasisRepair(Radii radii, NodeProofs<Dimension>& proofs, SignsJustAfter<Dimension>& signs)
      : radii_(radii), proofs_(proofs), signs_(signs) {}

  /// Returns the basis, just after now, of the beads of `old`, one of which may be superfluous, and of
  /// `bead`. `bead` has escaped from the sphere of `old`, or is no_bead. `failed` means that `bead` is the
  /// bead whose certificate fails now.
  [[nodiscard]] Basis next_basis(const Basis& old, BeadId bead, bool failed);

 private:
  static constexpr std::size_t full = Dimension + 1;

  [[nodiscard]] std::optional<Basis> proved_next_basis(const Basis& old, BeadId bead);
  [[nodiscard]] std::optional<Basis> basis_just_after(std::span<const BeadId> among, const Basis& old,
                                                      BeadId escaped);

  Radii radii_;
  NodeProofs<Dimension>& proofs_;
  SignsJustAfter<Dimension>& signs_;
};

}  // namespace kds
