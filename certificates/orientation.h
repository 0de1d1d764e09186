#pragma once
// Orientation in space: for beads p, q, r, s the sign of det[q-p, r-p, s-p], positive if s is on the side of
// the plane p, q, r from which they turn counterclockwise (CGAL's convention). Antisymmetric in its beads;
// zero iff they are coplanar. Exact; degree 3k for centres of degree k.

#include "certificates/certificate.h"
#include "certificates/determinant.h"
#include "certificates/sorted_beads.h"

namespace kds {

struct Orientation {
  std::array<BeadId, 4> beads{};  ///< ascending
  int sign = 1;

  Orientation() = default;
  /// Holds while `sign_wanted` times the orientation of the beads in this order is positive.
  Orientation(std::array<BeadId, 4> in_order, int sign_wanted) : beads(in_order) {
    sign = sign_wanted * sort_beads(beads);
  }

  [[nodiscard]] Identity identity() const {
    return {static_cast<std::uint32_t>(CertificateType::orientation),
            {beads[0], beads[1], beads[2], beads[3], no_bead}};
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 4>& beads) {
    return determinant(view.difference(beads[1], beads[0]), view.difference(beads[2], beads[0]),
                       view.difference(beads[3], beads[0]));
  }
};

}  // namespace kds
