#pragma once
// Certificates about two segments, or about a point and a triangle: their signs say whether the four points
// are coplanar, whether the point is in the triangle, and whether the segments meet. Exact; degree 3k
// (orientation) and 2k for centres of degree k.
//
// In a periodic cell, points of the second feature may be moved by a shift (shifted_difference.h). Without a
// shift, `to` and `from` are the same bead.

#include <array>
#include <cstddef>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/determinant.h"
#include "certificates/types/shifted_difference.h"

namespace kds {

/// The orientation of a, b, c, d, where c and d are moved by the shift: (b - a) x (c - a) . (d - c). If it
/// becomes positive while the segments ab and cd pass through each other, the linking number of two closed
/// strands that run along them rises by one.
struct SegmentsOrientation {
  static constexpr CertificateType type{20, "segments_orientation"};

  std::array<BeadId, 6> beads{};  ///< a, b, c, d, to, from
  int sign = 1;

  [[nodiscard]] Identity identity() const {
    return identity_with_shift(type, std::array{beads[0], beads[1], beads[2], beads[3]}, beads[4], beads[5]);
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 6>& b) {
    return determinant(view.difference(b[1], b[0]), shifted_difference(view, b[2], b[0], b[4], b[5]),
                       view.difference(b[3], b[2]));
  }
};

/// A component of the cross product (b - a) x (d - c), where d is moved by the shift.
template <int Axis>
struct CrossComponent {
  static_assert(0 <= Axis && Axis < 3);
  static constexpr std::array<CertificateType, 3> types{{{16, "cross_x"}, {17, "cross_y"}, {18, "cross_z"}}};
  static constexpr CertificateType type = types[Axis];

  std::array<BeadId, 6> beads{};  ///< a, b, c, d, to, from; beads may occur twice
  int sign = 1;

  [[nodiscard]] Identity identity() const {
    return identity_with_shift(type, std::array{beads[0], beads[1], beads[2], beads[3]}, beads[4], beads[5]);
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 6>& b) {
    constexpr std::size_t next = (Axis + 1) % 3, last = (Axis + 2) % 3;
    const auto first = view.difference(b[1], b[0]);
    const auto second = shifted_difference(view, b[3], b[2], b[4], b[5]);
    return minor(first[next], first[last], second[next], second[last]);
  }
};

/// Whether a point p on the line of a and b is beyond its ends, where a and b are moved by the shift:
/// (a - p).(b - p) is positive there, zero at an end, and negative between the ends.
struct BeyondEnds {
  static constexpr CertificateType type{19, "beyond_ends"};

  std::array<BeadId, 5> beads{};  ///< a, b, p, to, from
  int sign = 1;

  [[nodiscard]] Identity identity() const {
    return identity_with_shift(type, std::array{beads[0], beads[1], beads[2]}, beads[3], beads[4]);
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 5>& b) {
    return dot(shifted_difference(view, b[0], b[2], b[3], b[4]),
               shifted_difference(view, b[1], b[2], b[3], b[4]));
  }
};

}  // namespace kds
