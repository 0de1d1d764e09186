#pragma once
// Decides by certificates which bead lies in which sphere just after the present time (SphereSigns of
// basis.h). While a failure is handled, the sign of its certificate is known, and so is the sign of its
// function in other certificates.

#include <optional>

#include "certificates/types/orientation.h"
#include "kds/simulator.h"
#include "motions/curves/curves.h"
#include "motions/curves/motion_ref.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/hierarchy/membership_tables.h"

namespace kds {

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

}  // namespace kds
