#pragma once
// Power test in space: for beads p, q, r, s of positive orientation and a bead t, positive if t is outside
// their power sphere, the sphere orthogonal to the four balls: the sign of the determinant with rows
//   (x-p, |x-p|^2 - w_x + w_p)   for x = q, r, s, t.
// Antisymmetric in its five beads; zero iff a sphere is orthogonal to all five. Exact; degree 5k for centres
// of degree k and weights of degree at most 2k.

#include "certificates/certificate.h"
#include "certificates/determinant.h"
#include "certificates/sorted_beads.h"

namespace kds {

struct PowerTest {
  std::array<BeadId, 5> beads{};  ///< ascending
  int sign = 1;

  PowerTest() = default;
  /// Holds while `sign_wanted` times the power test of the beads in this order is positive.
  PowerTest(std::array<BeadId, 5> in_order, int sign_wanted) : beads(in_order) {
    sign = sign_wanted * sort_beads(beads);
  }

  [[nodiscard]] Identity identity() const {
    return {static_cast<std::uint32_t>(CertificateType::power_test), beads};
  }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 5>& beads) {
    using Number = typename View::Number;
    std::array<BernsteinVector<Number, View::degree, 3>, 4> rows;
    std::array<Bernstein<Number, 2 * View::degree>, 4> lifted;
    for (std::size_t i = 0; i < 4; ++i) {
      rows[i] = view.difference(beads[i + 1], beads[0]);
      lifted[i] =
          dot(rows[i], rows[i]) - elevate<2 * View::degree>(view.weight_difference(beads[i + 1], beads[0]));
    }
    return determinant(rows, lifted);
  }
};

}  // namespace kds
