#pragma once
// "Bead left lies before bead right along the first axis." Exact; degree k for centres of degree k.

#include "certificates/base/certificate.h"
#include "certificates/base/sorted_beads.h"

namespace kds {

struct Precedes {
  static constexpr CertificateType type{0, "precedes"};

  std::array<BeadId, 2> beads{};  ///< ascending
  int sign = 1;

  Precedes() = default;
  /// Holds while the first bead lies before the second.
  Precedes(std::array<BeadId, 2> in_order) : beads(in_order), sign(sort_beads(beads)) {}

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    return view.difference(beads[1], beads[0])[0];
  }
};

}  // namespace kds
