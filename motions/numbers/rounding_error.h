#pragma once
// Numbers that carry bounds on rounding errors: Tracked, a double with a running error bound (ball
// arithmetic), and Magnitude, from which a filter derives its fixed error bound.

#include <cmath>
#include <stdexcept>

#include "motions/base/floating_point_scope.h"

namespace kds {

/// A double, or four side by side, with a running error bound: |value - exact| <= error. The bound is updated
/// with each operation. A running bound is slower than a filter's fixed bound, but much sharper where numbers
/// differ widely in size. There is no assumption about ranges: overflow makes the bound infinite or NaN, and
/// losses from underflow are added to the bound, also where subnormal operands and results are flushed to
/// zero. Rounding must be to nearest (motions/base/floating_point_scope.h).
///
/// The bounds are rounded too, by a relative 2^-53 per operation. The user of a bound must therefore inflate
/// it once (`inflation`).
template <class Real>
struct Tracked {
  static constexpr double unit_roundoff = 0x1p-53;
  static constexpr double lost_to_underflow = 0x1p-1020;
  static constexpr double inflation = 1 + 0x1p-40;  // covers up to 2^10 operations in a row

  Real value{0.0};
  Real error{0.0};

  Tracked& operator+=(const Tracked& other) {
    using std::abs;
    value += other.value;
    error += other.error + Real(unit_roundoff) * abs(value) + Real(lost_to_underflow);
    return *this;
  }
  Tracked& operator-=(const Tracked& other) { return *this += -other; }
  Tracked operator-() const { return {-value, error}; }
  friend Tracked operator+(Tracked a, const Tracked& b) { return a += b; }
  friend Tracked operator-(Tracked a, const Tracked& b) { return a -= b; }
  friend Tracked operator*(const Tracked& a, const Tracked& b) {
    using std::abs;
    const Real product = a.value * b.value;
    const Real carried = abs(a.value) * b.error + a.error * (abs(b.value) + b.error);
    return {product, carried + Real(unit_roundoff) * abs(product) + Real(lost_to_underflow)};
  }
};

using TrackedDouble = Tracked<double>;

/// The number type that derives the error bound of a certificate's floating-point filter (a semi-static
/// filter). A magnitude bounds a quantity and its rounding error in terms of M, the largest input: the
/// largest difference of two coordinates, or sum of two radii (sums round like differences).
///
/// - The exact value is at most bound * M^power in size.
/// - The value computed with Digits binary digits (53: double, 24: float) errs by at most error * M^power.
///
/// Evaluating a certificate's function once on magnitudes yields the filter's constants, proved operation by
/// operation: fl(a op b) = (a op b)(1+d) with |d| <= 2^-Digits (Higham, Accuracy and Stability, 2.2). The
/// proof assumes round to nearest and no contraction.
///
/// The constants are themselves computed in double. ErrorBound (certificates/filters/bounded_polynomial.h)
/// inflates them once to cover that rounding, and to cover products that underflow.
template <int Digits>
struct MagnitudeIn {
  static_assert(Digits == 53 || Digits == 24);
  static constexpr double unit_roundoff = Digits == 53 ? 0x1p-53 : 0x1p-24;

  double bound = 0;
  double error = 0;
  int power = 0;

  /// Returns the magnitude of a rounded difference or sum of two inputs, at most M in size after rounding. A
  /// difference of floats may have been rounded to double first.
  static constexpr MagnitudeIn input_difference(int power_of_length) {
    constexpr double and_more = 1 + 8 * unit_roundoff;
    return {and_more, unit_roundoff * and_more, power_of_length};
  }
  /// Returns the magnitude of a small whole number, which is exact.
  static constexpr MagnitudeIn constant(double value) { return {value < 0 ? -value : value, 0, 0}; }

  constexpr MagnitudeIn& operator+=(const MagnitudeIn& other) {
    if (bound == 0 && error == 0) return *this = other;
    if (other.bound == 0 && other.error == 0) return *this;
    if (power != other.power) throw std::logic_error("certificate function adds unlike powers of length");
    bound += other.bound;
    error += other.error;
    error += unit_roundoff * (bound + error);
    return *this;
  }
  constexpr MagnitudeIn& operator-=(const MagnitudeIn& other) { return *this += other; }
  friend constexpr MagnitudeIn operator+(MagnitudeIn a, const MagnitudeIn& b) { return a += b; }
  friend constexpr MagnitudeIn operator-(MagnitudeIn a, const MagnitudeIn& b) { return a += b; }
  friend constexpr MagnitudeIn operator-(const MagnitudeIn& a) { return a; }
  friend constexpr MagnitudeIn operator*(const MagnitudeIn& a, const MagnitudeIn& b) {
    const double computed = (a.bound + a.error) * (b.bound + b.error);
    const double carried = a.bound * b.error + b.bound * a.error + a.error * b.error;
    return {a.bound * b.bound, carried + unit_roundoff * computed, a.power + b.power};
  }
};

using Magnitude = MagnitudeIn<53>;

}  // namespace kds
