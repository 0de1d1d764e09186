#pragma once
// Compares two pairs of beads: the centres of the first pair are closer together than those of the second,
// |c - d|^2 - |a - b|^2 > 0. Exact; degree 2k for centres of degree k.

#include <algorithm>

#include "certificates/base/certificate.h"

namespace kds {

struct Closer {
  static constexpr CertificateType type{12, "closer"};
  static constexpr int lanes_up_to_degree = 3;

  std::array<BeadId, 4> beads{};  ///< the lesser pair, ascending, then the other; the pairs may share a bead
  int sign = 1;

  Closer() = default;
  /// Holds while the first pair is closer. Both pairs must be ascending.
  Closer(std::array<BeadId, 2> near, std::array<BeadId, 2> far) : sign(near < far ? 1 : -1) {
    const auto& [lesser, greater] = std::minmax(near, far);
    beads = {lesser[0], lesser[1], greater[0], greater[1]};
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 4>& beads) {
    const auto lesser = view.difference(beads[1], beads[0]), greater = view.difference(beads[3], beads[2]);
    return dot(greater, greater) - dot(lesser, lesser);
  }
};

}  // namespace kds
