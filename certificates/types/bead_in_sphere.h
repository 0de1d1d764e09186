#pragma once
// A bead in the minimum enclosing sphere of a basis of beads of equal radii, for bases of 1, 2 and 3 beads,
// and in that sphere relaxed.
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
#include "certificates/base/relaxation.h"

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

// A bead in the relaxed minimum enclosing sphere of a basis of beads of equal radii: the sphere is enlarged
// by a share eps of its radius. For bases of 2 and 3 beads, and of 4 in space. With sigma = (1 + eps)^2 - 1,
// and c and R the sphere of the centres, the certificate holds while |x - c|^2 <= (1 + sigma) R^2. With d_i =
// c_i - c_0 and g as above, this is sigma R^2 + (R^2 - |x - c|^2) >= 0 times a positive number:
//
//   2 beads   sigma |d|^2 - 4 (x - a).(x - b)                                degree 2k
//   3 beads   sigma |d_1|^2 |d_2|^2 |d_1 - d_2|^2 + 4 times F there          6k; times 4 g
//   4 beads   sigma |E|^2 + 4 q (d_x.E - q |d_x|^2)                          8k; times 4 q^2
//
// where q = d_1.(d_2 x d_3) and E = |d_1|^2 d_2 x d_3 + ... = 2 q (c - c_0). No orientation is needed.
//
// A bead of radius r whose certificate holds is inside the sphere of the balls, of radius R + r, enlarged by
// eps: |x - c| + r <= (1 + eps) R + r. Exact; all quantities are in units of 2^-40 (relaxation.h).

template <int Size>
struct RelaxedBeadInSphere {
  static_assert(Size >= 2 && Size <= 4);
  static constexpr CertificateType type{8, "relaxed_bead_in_sphere"};

  using Beads = RelaxedBeads<Size + 1>;

  Beads beads{};  ///< the basis, ascending, then the bead

  RelaxedBeadInSphere() = default;
  RelaxedBeadInSphere(const std::array<BeadId, Size + 1>& of, const Relaxation& relaxation)
      : beads{of, relaxation} {}

  /// Returns the identity. The last place of the identity distinguishes relaxations.
  [[nodiscard]] Identity identity() const {
    Identity identity = identity_of(type, beads);
    identity.beads.back() = static_cast<BeadId>(beads.relaxation.units());
    return identity;
  }

  [[nodiscard]] bool side() const { return true; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const Beads& beads) {
    constexpr std::int64_t four = 4 * Relaxation::one_squared;
    const std::int64_t sigma = beads.relaxation.square_units();
    const auto d1 = view.difference(beads[1], beads[0]);
    const auto dj = view.difference(beads[Size], beads[0]);
    if constexpr (Size == 2) {
      return times(sigma, dot(d1, d1)) - times(four, dot(dj, view.difference(beads[2], beads[1])));
    } else if constexpr (Size == 3) {
      const auto d2 = view.difference(beads[2], beads[0]);
      const auto across = view.difference(beads[2], beads[1]);
      const auto g11 = dot(d1, d1);
      const auto g12 = dot(d1, d2);
      const auto g22 = dot(d2, d2);
      const auto a1 = g22 * (g11 - g12);
      const auto a2 = g11 * (g22 - g12);
      const auto excess = dot(dj, d1) * a1 + dot(dj, d2) * a2 - (g11 * g22 - g12 * g12) * dot(dj, dj);
      return times(sigma, g11 * g22 * dot(across, across)) + times(four, excess);
    } else {
      const auto d2 = view.difference(beads[2], beads[0]);
      const auto d3 = view.difference(beads[3], beads[0]);
      const auto n1 = cross(d2, d3);
      const auto n2 = cross(d3, d1);
      const auto n3 = cross(d1, d2);
      const auto e1 = dot(d1, d1);
      const auto e2 = dot(d2, d2);
      const auto e3 = dot(d3, d3);
      const auto q = dot(d1, n1);
      const std::array center{e1 * n1[0] + e2 * n2[0] + e3 * n3[0], e1 * n1[1] + e2 * n2[1] + e3 * n3[1],
                              e1 * n1[2] + e2 * n2[2] + e3 * n3[2]};
      return times(sigma, dot(center, center)) + times(four, q * (dot(dj, center) - q * dot(dj, dj)));
    }
  }
};

}  // namespace kds
