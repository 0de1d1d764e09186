#pragma once
// Power test: for beads p, q, r (and s in space) of positive orientation and a bead t, positive if t is
// outside their power circle (sphere), the one orthogonal to all of them: the sign of the determinant with
// rows
//   (x-p, |x-p|^2 - w_x + w_p)   for x = q, r, (s,) t.
// Antisymmetric in its beads; zero iff one circle (sphere) is orthogonal to all. Exact; for centres of degree
// k and weights of degree at most 2k of degree 4k in the plane and 5k in space.

#include "certificates/certificate.h"
#include "certificates/determinant.h"
#include "certificates/sorted_beads.h"

namespace kds {

template <int Dimension>
struct PowerTest {
  static_assert(Dimension == 2 || Dimension == 3);
  static constexpr std::size_t size = Dimension + 2;
  static constexpr bool uses_weights = true;

  std::array<BeadId, size> beads{};  ///< ascending
  int sign = 1;

  PowerTest() = default;
  /// Holds while `sign_wanted` times the power test of the beads in this order is positive.
  PowerTest(std::array<BeadId, size> in_order, int sign_wanted) : beads(in_order) {
    sign = sign_wanted * sort_beads(beads);
  }

  [[nodiscard]] Identity identity() const { return identity_of(CertificateType::power_test, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, size>& beads) {
    using Number = typename View::Number;
    std::array<BernsteinVector<Number, View::degree, Dimension>, Dimension + 1> rows;
    std::array<Bernstein<Number, 2 * View::degree>, Dimension + 1> lifted;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      rows[i] = view.difference(beads[i + 1], beads[0]);
      lifted[i] =
          dot(rows[i], rows[i]) - elevate<2 * View::degree>(view.weight_difference(beads[i + 1], beads[0]));
    }
    return determinant(rows, lifted);
  }
};

}  // namespace kds
