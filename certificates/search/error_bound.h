#pragma once
// The floating-point filter of a certificate type, derived from its function (motions/numbers/magnitude.h).
//
// Let M be the largest difference that went into one evaluation in double (DoubleView::largest_length), and h
// the function's degree in lengths. Then coefficient k, in scaled Bernstein form, errs by at most
// coefficient[k] * M^h. Proved for 2^-900 <= M^h <= 2^900: there nothing overflows, and a product that
// underflows errs by at most 2^-1075 times factors whose product is below M^(h-p) for a power p <= h that it
// carried itself, at most 2^-122 of the least bound; the constants are inflated by more than that. Outside
// this range the filter says nothing.
//
// From these follow two bounds for the plain Bernstein coefficients c, whose division by binomials rounds
// once more: any value at a double errs by at most uniform * M^h + value_rounding(n) * max|c|, and the
// coefficients on any part of [0,1], which two subdivisions lead to, by uniform * M^h +
// local_rounding(n) * max|c|.
//
// One subdivision is n rounds of (1-t) a + t b. A round errs by at most 4u max|c| (two products, one sum,
// 1-t), and t itself, at most a quotient of such numbers, by 4u, which moves a coefficient by at most 2n * 4u
// max|c|. Together 12 u n max|c|; evaluation at a double is one subdivision.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "certificates/base/certificate.h"

namespace kds {

inline constexpr int subdivisions = 2;  // one cuts off what is after the part, one what is before
[[nodiscard]] constexpr double value_rounding(int degree) {
  return 12 * Magnitude::unit_roundoff * (1 + 0x1p-30) * degree;
}
[[nodiscard]] constexpr double local_rounding(int degree) {
  return (subdivisions + 2) * value_rounding(degree);
}

template <int Degree>
struct ErrorBound {
  int power = 0;  ///< h
  std::array<double, static_cast<std::size_t>(Degree) + 1> coefficient{};
  double uniform = 0;

  /// M^h, or a NaN that fails every comparison where the bound is not proved.
  [[nodiscard]] double scale(double largest_length) const {
    double result = 1;
    for (int i = 0; i < power; ++i) result *= largest_length;
    return result >= 0x1p-900 && result <= 0x1p900 ? result : std::nan("");
  }
};

template <class Certificate, class M>
ErrorBound<decltype(function_of(Certificate{}, DoubleView<M>(std::declval<const M&>())))::degree>
derive_error_bound() {
  const auto magnitudes = function_of(Certificate{}, MagnitudeViewOf<M>{});
  constexpr int degree = decltype(magnitudes)::degree;
  constexpr double inflation = 1 + 0x1p-30;
  constexpr double u = Magnitude::unit_roundoff;

  ErrorBound<degree> bound;
  for (std::size_t k = 0; k < magnitudes.scaled.size(); ++k) {
    const Magnitude& m = magnitudes.scaled[k];
    const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
    bound.power = m.power;
    bound.coefficient[k] = m.error * inflation;
    bound.uniform = std::max(bound.uniform, (m.error + u * (m.bound + m.error)) / choose * inflation);
  }
  return bound;
}

template <class Certificate, class M>
inline const auto error_bound = derive_error_bound<Certificate, M>();

}  // namespace kds
