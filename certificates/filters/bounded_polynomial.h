#pragma once
// The double stage: the error bound of a certificate type's filter, and polynomials whose coefficients are
// known up to a proved error.

#include <cmath>
#include <cstdint>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/rounding_error.h"

namespace kds {

// The error bound is derived from the type's function by evaluating it on magnitudes
// (motions/numbers/rounding_error.h).
//
// Let M be the largest difference that enters one evaluation in double (DoubleView::largest_length), and h
// the function's degree in lengths. Then coefficient k, in scaled Bernstein form, has an error of at most
// coefficient[k] * M^h.
//
// The bound is proved for 2^-900 <= M^h <= 2^900. In this range nothing overflows. A product that underflows
// has an error of at most 2^-1022, whether it is flushed to zero or not, times factors whose product is below
// M^(h-p), where p <= h is the power that the product itself carried. That is at most 2^-69 of the smallest
// bound, and the constants are inflated by more. Outside this range the filter is undecided. Rounding must be
// to nearest (motions/base/floating_point_scope.h).
//
// Two bounds for the plain Bernstein coefficients c follow. The division of c by binomials rounds once more.
//
// - Any value at a double has an error of at most uniform * M^h + value_rounding(n) * max|c|.
// - The coefficients on any part of [0,1], computed by two subdivisions, have an error of at most uniform *
//   M^h + local_rounding(n) * max|c|.
//
// One subdivision is n rounds of (1-t) a + t b. The rounding of one round is at most 4u max|c| (two products,
// one sum, 1-t). t itself is at most a quotient of such numbers, so its error is at most 4u, which moves a
// coefficient by at most 2n * 4u max|c|. Together the error is 12 u n max|c|. Evaluation at a double is one
// subdivision.

inline constexpr int subdivisions = 2;  // one cuts off the polynomial after the part, the other before it
[[nodiscard]] constexpr double value_rounding(int degree) {
  return 12 * Magnitude::unit_roundoff * (1 + 0x1p-30) * degree;
}
[[nodiscard]] constexpr double local_rounding(int degree) {
  return (subdivisions + 2) * value_rounding(degree);
}

/// The error bound of a certificate type's filter in double.
struct ErrorBound {
  int power = 0;  ///< h
  Coefficients<double> coefficient;
  double uniform = 0;

  /// Returns M^h, or a NaN, which fails every comparison, if the bound is not proved.
  [[nodiscard]] double scale(double largest_length) const {
    double result = 1;
    for (int i = 0; i < power; ++i) result *= largest_length;
    return result >= 0x1p-900 && result <= 0x1p900 ? result : std::nan("");
  }
};

enum class Verdict : std::uint8_t { never, found, undecided };

/// A polynomial whose Bernstein coefficients are known up to a proved error, and the search for the first
/// time at which it certainly turns negative. The work is bounded; if a result cannot be proved, the class
/// says so.
struct BoundedPolynomial {
  Coefficients<double> bernstein;  ///< plain Bernstein coefficients on [0,1], at least one
  double value_error = 0;          ///< error of any value at a double
  double local_error = 0;          ///< error of coefficients after subdivision; NaN: nothing can be proved

  struct Bracket {
    double lower, upper;
  };
  struct Result {
    Verdict verdict;
    Bracket bracket;
  };

  [[nodiscard]] int degree() const { return static_cast<int>(bernstein.size()) - 1; }
  [[nodiscard]] double value_at(double u) const;
  /// Returns 1 or -1 if that is certainly the sign at u, else 0.
  [[nodiscard]] int certain_sign_at(double u) const;
  /// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const;

  /// Returns the first root after `from` at which the polynomial turns negative, in a bracket that proves it:
  /// the polynomial is certainly positive on [from, lower] and negative at upper, with one root between. At
  /// `from` it must be certainly positive, either by its value or because it is `known` to be.
  [[nodiscard]] Result first_descent(double from, bool known = false) const;

  /// Returns a point near the root of the only descent between `lower` and `upper`, computed from the
  /// coefficients without error bounds. Proves nothing.
  [[nodiscard]] double root_between(double lower, double upper) const;
};

[[nodiscard]] BoundedPolynomial operator-(BoundedPolynomial p);

}  // namespace kds
