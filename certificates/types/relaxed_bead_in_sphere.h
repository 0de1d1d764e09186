#pragma once
// A bead in the relaxed minimum enclosing sphere of a basis of beads of equal radii: the sphere is enlarged
// by a share eps of its radius. For bases of 2 and 3 beads, and of 4 in space. With sigma = (1 + eps)^2 - 1,
// and c and R the sphere of the centres, the certificate holds while |x - c|^2 <= (1 + sigma) R^2. With d_i =
// c_i - c_0 and g as in bead_in_sphere.h, this is sigma R^2 + (R^2 - |x - c|^2) >= 0 times a positive number:
//
//   2 beads   sigma |d|^2 - 4 (x - a).(x - b)                                degree 2k
//   3 beads   sigma |d_1|^2 |d_2|^2 |d_1 - d_2|^2 + 4 times F there          6k; times 4 g
//   4 beads   sigma |E|^2 + 4 q (d_x.E - q |d_x|^2)                          8k; times 4 q^2
//
// where q = d_1.(d_2 x d_3) and E = |d_1|^2 d_2 x d_3 + ... = 2 q (c - c_0). No orientation is needed.
//
// A bead of radius r whose certificate holds is inside the sphere of the balls, of radius R + r, enlarged by
// eps: |x - c| + r <= (1 + eps) R + r. Exact; all quantities are in units of 2^-40 (relaxation.h).

#include "certificates/base/certificate.h"
#include "certificates/base/determinant.h"
#include "certificates/types/relaxed_beads.h"

namespace kds {

template <int Size>
struct RelaxedBeadInSphere {
  static_assert(Size >= 2 && Size <= 4);
  static constexpr CertificateType type{8, "relaxed_bead_in_sphere"};

  using Beads = RelaxedBeads<Size + 1>;

  Beads beads{};  ///< the basis, ascending, then the bead

  RelaxedBeadInSphere() = default;
  RelaxedBeadInSphere(const std::array<BeadId, Size + 1>& of, const Relaxation& relaxation)
      : beads{of, relaxation} {}

  /// Returns the identity. Its last place distinguishes relaxations.
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
