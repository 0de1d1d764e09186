#pragma once
// Power test: for beads p, q, r (and s in space) of positive orientation, the power test of a bead t is
// positive if t is outside their power circle (sphere), which is orthogonal to all of them. The power test is
// the sign of the determinant with rows
//   (x-p, |x-p|^2 - w_x + w_p)   for x = q, r, (s,) t.
// Antisymmetric in its beads; zero iff one circle (sphere) is orthogonal to all. Exact. For centres of degree
// k and weights of degree at most 2k, the degree is 4k in the plane and 5k in space; in lifted motion it is 3
// and 4.

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/determinant.h"

namespace kds {

/// Returns the last entry of a row of the determinant, for beads x and p whose centres differ by `centre`.
template <MotionView View>
[[nodiscard, gnu::always_inline]] inline auto power_lift(
    const View& view, BeadId x, BeadId p,
    [[maybe_unused]] const BernsteinVector<typename View::Number, View::degree, View::dimension>& centre) {
  if constexpr (LiftedView<View>) {
    return view.lift_difference(x, p);
  } else {
    return dot(centre, centre) - elevate<2 * View::degree>(view.weight_difference(x, p));
  }
}

template <int Dimension>
struct PowerTest {
  static_assert(Dimension == 2 || Dimension == 3);
  static constexpr CertificateType type{2, "power_test"};
  static constexpr int lanes_up_to_degree = 3;
  static constexpr std::size_t size = Dimension + 2;
  static constexpr bool uses_weights = true;

  std::array<BeadId, size> beads{};  ///< ascending
  int sign = 1;

  PowerTest() = default;
  /// Holds while `sign_wanted` times the power test of the beads in this order is positive.
  PowerTest(std::array<BeadId, size> in_order, int sign_wanted) : beads(in_order) {
    sign = sign_wanted * sort_beads(beads);
  }

  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }

  [[nodiscard]] bool side() const { return sign > 0; }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, size>& beads) {
    std::array<BernsteinVector<typename View::Number, View::degree, Dimension>, Dimension + 1> rows;
    std::array<decltype(power_lift(view, beads[1], beads[0], rows[0])), Dimension + 1> lifts;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      rows[i] = view.difference(beads[i + 1], beads[0]);
      lifts[i] = power_lift(view, beads[i + 1], beads[0], rows[i]);
    }
    return determinant(rows, lifts);
  }
};

}  // namespace kds
