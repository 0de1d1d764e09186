#pragma once
// Decides by certificates which bead lies in which sphere (SphereSigns of basis.h).

#include <algorithm>
#include <span>
#include <utility>

#include "certificates/types/membership.h"
#include "certificates/types/orientation.h"
#include "motions/curves/curves.h"
#include "structures/enclosing_sphere/basis.h"

namespace kds {

/// `sign(certificate)` returns 1, 0 or -1 for any membership or orientation certificate.
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

}  // namespace kds
