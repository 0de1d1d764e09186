#pragma once
// Certificates about segments and triangles: with the orientation of four points (orientation.h), their signs
// say whether a point lies in a triangle and whether two segments meet. Exact; degree 2k for centres of
// degree k.

#include <array>
#include <cstddef>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/determinant.h"

namespace kds {

/// A component of the cross product (b - a) x (d - c) of two segments ab and cd.
template <int Axis>
struct CrossComponent {
  static_assert(0 <= Axis && Axis < 3);
  static constexpr std::array<CertificateType, 3> types{{{16, "cross_x"}, {17, "cross_y"}, {18, "cross_z"}}};
  static constexpr CertificateType type = types[Axis];

  std::array<BeadId, 4> beads{};  ///< a, b, c, d; the segments may share ends
  int sign = 1;

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 4>& beads) {
    constexpr std::size_t next = (Axis + 1) % 3, last = (Axis + 2) % 3;
    const auto first = view.difference(beads[1], beads[0]), second = view.difference(beads[3], beads[2]);
    return minor(first[next], first[last], second[next], second[last]);
  }
};

/// Whether a point p on the line of a and b is beyond its ends: (a - p).(b - p) is positive there, zero at an
/// end, and negative between the ends.
struct BeyondEnds {
  static constexpr CertificateType type{19, "beyond_ends"};

  std::array<BeadId, 3> beads{};  ///< a, b, p
  int sign = 1;

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 3>& beads) {
    return dot(view.difference(beads[0], beads[2]), view.difference(beads[1], beads[2]));
  }
};

}  // namespace kds
