#pragma once
// "Bead left lies before bead right along an axis", by default the first axis. Exact; degree k for centres of
// degree k.

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"

namespace kds {

template <int Axis>
struct PrecedesAlong {
  static_assert(0 <= Axis && Axis < 3);
  static constexpr std::array<CertificateType, 3> types{
      {{0, "precedes"}, {10, "precedes_in_y"}, {11, "precedes_in_z"}}};
  static constexpr CertificateType type = types[Axis];
  static constexpr int lanes_up_to_degree = 3;

  std::array<BeadId, 2> beads{};  ///< ascending
  int sign = 1;

  PrecedesAlong() = default;
  /// Holds while the first bead lies before the second.
  PrecedesAlong(std::array<BeadId, 2> in_order) : beads(in_order), sign(sort_beads(beads)) {}

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    return view.difference(beads[1], beads[0])[Axis];
  }
};

using Precedes = PrecedesAlong<0>;

}  // namespace kds
