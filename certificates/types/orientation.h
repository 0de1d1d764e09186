#pragma once
// Orientation (CGAL's conventions). In the plane, for beads p, q, r: the sign of det[q-p, r-p], positive if
// they turn counterclockwise. In space, for p, q, r, s: the sign of det[q-p, r-p, s-p], positive if p, q, r
// turn counterclockwise seen from s. Antisymmetric in its beads; zero iff the beads are collinear (coplanar).
// Exact; degree 2k (3k) for centres of degree k.

#include "certificates/base/certificate.h"
#include "certificates/base/determinant.h"
#include "certificates/base/sorted_beads.h"

namespace kds {

template <int Dimension>
struct Orientation {
  static_assert(Dimension == 2 || Dimension == 3);
  static constexpr CertificateType type{1, "orientation"};
  static constexpr int lanes_up_to_degree = 3;
  static constexpr std::size_t size = Dimension + 1;

  std::array<BeadId, size> beads{};  ///< ascending
  int sign = 1;

  Orientation() = default;
  /// Holds while `sign_wanted` times the orientation of the beads in this order is positive.
  Orientation(std::array<BeadId, size> in_order, int sign_wanted) : beads(in_order) {
    sign = sign_wanted * sort_beads(beads);
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, size>& beads) {
    const auto a = view.difference(beads[1], beads[0]);
    const auto b = view.difference(beads[2], beads[0]);
    if constexpr (Dimension == 2) {
      return minor(a[0], a[1], b[0], b[1]);
    } else {
      return determinant(a, b, view.difference(beads[3], beads[0]));
    }
  }
};

}  // namespace kds
