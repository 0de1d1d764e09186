#pragma once
// A user-defined certificate type: bead a is farther from bead c than bead b is.

#include <array>

#include "certificates/base/certificate.h"

namespace extension {

struct Farther {
  static constexpr kds::CertificateType type{1003, "farther"};

  std::array<kds::BeadId, 3> beads{};  ///< a, b, c
  int sign = 1;

  [[nodiscard]] kds::Identity identity() const { return kds::identity_of(type, beads); }
  [[nodiscard]] bool side() const { return sign > 0; }

  template <kds::MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<kds::BeadId, 3>& b) {
    const auto far = view.difference(b[0], b[2]), near = view.difference(b[1], b[2]);
    return dot(far, far) - dot(near, near);
  }
};

}  // namespace extension
