#pragma once
// A bead in the minimum enclosing sphere of a basis of beads of equal radii, for bases of 1, 2 and 3 beads.
//
// Equal radii make the centre rational. With d_i = c_i - c_0, Q = [d_1..d_m], G = Q^T Q, g = det G, A = adj
// G, e_i = |d_i|^2 / 2, the centre is c_0 + Q A e / g, and bead j is inside iff F = d_j . (Q A e) - g e_j
// >= 0. The table gives 2F.
//
//   1 bead    -|d_j|^2                      inside only where it coincides
//   2 beads   -(p - a).(p - b)              degree 2k
//   3 beads   2F                            degree 6k
//   4 beads   a power test times the orientation of the basis (power_test.h), degree 5k
//
// `inside` certificates guard a bead that must stay inside. The others guard a basis bead that must stay
// outside of the sphere of the other basis beads; if it enters, it leaves the basis (its barycentric
// coordinate vanishes then). Exact.

#include "certificates/base/certificate.h"
#include "certificates/base/determinant.h"

namespace kds {

template <int Size>
struct BeadInSphere {
  static_assert(Size >= 1 && Size <= 3);
  static constexpr CertificateType type{3, "bead_in_sphere"};
  static constexpr int lanes_up_to_degree = 3;

  std::array<BeadId, Size + 1> beads{};  ///< the basis, ascending, then the bead
  bool inside = true;

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return inside; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, Size + 1>& beads) {
    if constexpr (Size == 1) {
      const auto d = view.difference(beads[1], beads[0]);
      return -dot(d, d);
    } else if constexpr (Size == 2) {
      return -dot(view.difference(beads[2], beads[0]), view.difference(beads[2], beads[1]));
    } else {
      const auto d1 = view.difference(beads[1], beads[0]);
      const auto d2 = view.difference(beads[2], beads[0]);
      const auto dj = view.difference(beads[3], beads[0]);
      const auto g11 = dot(d1, d1);
      const auto g12 = dot(d1, d2);
      const auto g22 = dot(d2, d2);
      // 2 A e = (g22 (g11 - g12), g11 (g22 - g12)), the circumcentre's weights on d1 and d2 times 2g.
      const auto a1 = g22 * (g11 - g12);
      const auto a2 = g11 * (g22 - g12);
      const auto g = g11 * g22 - g12 * g12;
      return dot(dj, d1) * a1 + dot(dj, d2) * a2 - g * dot(dj, dj);
    }
  }
};

}  // namespace kds
