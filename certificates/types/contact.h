#pragma once
// Contact of two balls: |c_i - c_j|^2 - (r_i + r_j)^2 is positive while they are disjoint, zero while they
// touch, and negative while they overlap. Radii may change, but the sum of both must not be negative. Exact;
// degree 2k for centres and radii of degree k.

#include "certificates/base/certificate.h"
#include "certificates/base/sorted_beads.h"

namespace kds {

struct Contact {
  static constexpr CertificateType type{4, "contact"};
  static constexpr int lanes_up_to_degree = 3;
  static constexpr bool uses_radii = true;

  std::array<BeadId, 2> beads{};  ///< ascending
  int sign = 1;

  Contact() = default;
  /// Holds while the balls are disjoint, or, if `sign_wanted` is -1, while they overlap.
  Contact(std::array<BeadId, 2> in_any_order, int sign_wanted) : beads(in_any_order), sign(sign_wanted) {
    static_cast<void>(sort_beads(beads));
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    const auto d = view.difference(beads[1], beads[0]);
    const auto reach = view.radius_sum(beads[1], beads[0]);
    return dot(d, d) - reach * reach;
  }
};

}  // namespace kds
