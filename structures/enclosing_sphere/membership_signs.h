#pragma once
// Who lies in which sphere, by certificates (SphereSigns of basis.h).

#include <concepts>
#include <span>

#include "certificates/types/membership.h"
#include "certificates/types/orientation.h"
#include "structures/enclosing_sphere/basis.h"

namespace kds {

/// `sign(certificate)` says 1, 0 or -1 for any certificate of membership and any orientation.
template <Radii radii, Motion M, class Sign>
class MembershipSigns {
 public:
  static constexpr int dimension = M::dimension;

  MembershipSigns(const M& motion, Sign sign) : motion_(motion), sign_(std::move(sign)) {}

  [[nodiscard]] int membership(const Basis& basis, BeadId bead, bool inside, int orientation) const {
    return visit_membership<radii>(motion_, std::span(basis.begin(), basis.end()), bead, inside, orientation,
                                   sign_);
  }
  [[nodiscard]] int orientation(const Basis& basis) const {
    Orientation<dimension> certificate;
    std::copy_n(basis.begin(), dimension + 1, certificate.beads.begin());
    return sign_(certificate);
  }

 private:
  const M& motion_;
  Sign sign_;
};

}  // namespace kds
