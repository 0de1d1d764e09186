#pragma once
// The floating-point filter of a certificate type, derived from its function (motions/magnitude.h).
//
// Let M be the largest difference that went into one evaluation in double (DoubleView::largest_length), and h
// the function's degree in lengths. Then coefficient k, in scaled Bernstein form, errs by at most
// coefficient[k] * M^h. Proved for 2^-900 <= M^h <= 2^900: there nothing overflows, and a product that
// underflows errs by at most 2^-1075 times factors whose product is below M^(h-p) for a power p <= h that it
// carried itself, at most 2^-122 of the least bound; the constants are inflated by more than that. Outside
// this range the filter says nothing.
//
// `value` bounds the error of any value of the polynomial evaluated at one double, `local` that of Bernstein
// coefficients on any part of [0,1] that at most `subdivisions` subdivisions lead to.

#include <array>
#include <cmath>
#include <cstddef>

#include "certificates/certificate.h"

namespace kds {

template <int Degree>
struct ErrorBound {
  static constexpr int subdivisions = 32;

  int power = 0;  ///< h
  std::array<double, static_cast<std::size_t>(Degree) + 1> coefficient{};
  double value = 0;
  double local = 0;

  /// M^h, or a NaN that fails every comparison where the bound is not proved.
  [[nodiscard]] double scale(double largest_length) const {
    double result = 1;
    for (int i = 0; i < power; ++i) result *= largest_length;
    return result >= 0x1p-900 && result <= 0x1p900 ? result : std::nan("");
  }
};

template <class Certificate, class M>
ErrorBound<decltype(Certificate{}.function(DoubleView<M>(std::declval<const M&>())))::degree>
derive_error_bound() {
  const auto magnitudes = Certificate{}.function(MagnitudeView<M::dimension, M::degree>{});
  constexpr int degree = decltype(magnitudes)::degree;
  constexpr double inflation = 1 + 0x1p-30;
  constexpr double u = Magnitude::unit_roundoff;

  ErrorBound<degree> bound;
  double size = 0;     // of Bernstein coefficients
  double uniform = 0;  // error of Bernstein coefficients, hence of all values
  for (std::size_t k = 0; k < magnitudes.scaled.size(); ++k) {
    const Magnitude& m = magnitudes.scaled[k];
    const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
    bound.power = m.power;
    bound.coefficient[k] = m.error * inflation;
    size = std::max(size, (m.bound + m.error) / choose);
    uniform =
        std::max(uniform, (m.error + u * (m.bound + m.error)) / choose);  // one more rounding: the division
  }
  // One subdivision is `degree` rounds of (1-t) a + t b. A round errs by at most 4u times the largest
  // coefficient (two products, one sum, 1-t), and t itself, (m-a)/(b-a) rounded three times, by 4u, which
  // moves a coefficient by at most 2 degree * size * 4u. Together 12 u degree size; evaluation at a double is
  // one subdivision.
  const double once = 12 * u * degree * size;
  bound.value = (uniform + once) * inflation;
  bound.local = (uniform + (ErrorBound<degree>::subdivisions + 2) * once) * inflation;
  return bound;
}

template <class Certificate, class M>
inline const auto error_bound = derive_error_bound<Certificate, M>();

}  // namespace kds
