#pragma once
// "Bead left lies before bead right along the first axis." Exact; degree k for centres of degree k.

#include "certificates/certificate.h"

namespace kds {

struct Precedes {
  std::array<BeadId, 2> beads{};  ///< left, right

  [[nodiscard]] Identity identity() const {
    const auto [low, high] = std::minmax(beads[0], beads[1]);
    return {static_cast<std::uint32_t>(CertificateType::precedes), {low, high, no_bead, no_bead, no_bead}};
  }

  [[nodiscard]] bool side() const { return beads[0] < beads[1]; }

  template <MotionView View>
  [[nodiscard]] auto function(const View& view) const {
    return view.difference(beads[1], beads[0])[0];
  }
};

}  // namespace kds
