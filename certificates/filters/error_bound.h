#pragma once
// The floating-point filter of a certificate type, derived from its function (motions/numbers/magnitude.h).
//
// Let M be the largest difference that went into one evaluation in double (DoubleView::largest_length), and h
// the function's degree in lengths. Then coefficient k, in scaled Bernstein form, errs by at most
// coefficient[k] * M^h. Proved for 2^-900 <= M^h <= 2^900: there nothing overflows, and a product that
// underflows errs by at most 2^-1022, flushed to zero or not, times factors whose product is below M^(h-p)
// for a power p <= h that it carried itself, at most 2^-69 of the least bound; the constants are inflated by
// more than that. Outside this range the filter says nothing. Rounding is to nearest
// (motions/base/floating_point_guard.h).
//
// From these follow two bounds for the plain Bernstein coefficients c, whose division by binomials rounds
// once more: any value at a double errs by at most uniform * M^h + value_rounding(n) * max|c|, and the
// coefficients on any part of [0,1], which two subdivisions lead to, by uniform * M^h +
// local_rounding(n) * max|c|.
//
// One subdivision is n rounds of (1-t) a + t b. A round errs by at most 4u max|c| (two products, one sum,
// 1-t), and t itself, at most a quotient of such numbers, by 4u, which moves a coefficient by at most 2n * 4u
// max|c|. Together 12 u n max|c|; evaluation at a double is one subdivision.

#include <cmath>

#include "motions/numbers/coefficients.h"
#include "motions/numbers/magnitude.h"

namespace kds {

inline constexpr int subdivisions = 2;  // one cuts off what is after the part, one what is before
[[nodiscard]] constexpr double value_rounding(int degree) {
  return 12 * Magnitude::unit_roundoff * (1 + 0x1p-30) * degree;
}
[[nodiscard]] constexpr double local_rounding(int degree) {
  return (subdivisions + 2) * value_rounding(degree);
}

struct ErrorBound {
  int power = 0;  ///< h
  Coefficients<double> coefficient;
  double uniform = 0;

  /// M^h, or a NaN that fails every comparison where the bound is not proved.
  [[nodiscard]] double scale(double largest_length) const {
    double result = 1;
    for (int i = 0; i < power; ++i) result *= largest_length;
    return result >= 0x1p-900 && result <= 0x1p900 ? result : std::nan("");
  }
};

}  // namespace kds
