#pragma once
// The number type that derives a certificate's floating-point filter. It stands for a quantity whose exact
// value is at most bound * M^power in size and whose computation, in numbers of so many binary digits (53:
// double, 24: float), errs by at most error * M^power, where M is the largest difference (or sum of two
// radii, which rounds alike) that went in. Evaluating a certificate's function once on magnitudes gives the
// constants of a semi-static filter, proved operation by operation (Higham, Accuracy and Stability, 2.2:
// fl(a op b) = (a op b)(1+d), |d| <= 2^-digits; no contraction, round to nearest).
//
// The constants are computed in double themselves; error_bound.h inflates them once for that, and for
// products that underflow.

#include <stdexcept>

namespace kds {

template <int Digits>
struct MagnitudeIn {
  static_assert(Digits == 53 || Digits == 24);
  static constexpr double unit_roundoff = Digits == 53 ? 0x1p-53 : 0x1p-24;

  double bound = 0;
  double error = 0;
  int power = 0;

  /// A rounded difference or sum of two inputs, at most M in size once rounded; a float may have been rounded
  /// to double before.
  static constexpr MagnitudeIn input_difference(int power_of_length) {
    constexpr double and_more = 1 + 8 * unit_roundoff;
    return {and_more, unit_roundoff * and_more, power_of_length};
  }
  /// A small whole number, exact.
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
