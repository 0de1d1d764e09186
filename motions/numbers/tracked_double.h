#pragma once
// A double, or four side by side, with a running error bound: |value - exact| <= error. The bound is updated
// with each operation. This is slower than a filter's fixed bound, but much sharper where numbers differ
// widely in size. There is no assumption about ranges: overflow makes the bound infinite or NaN, and losses
// from underflow are added to the bound, also where subnormal operands and results are flushed to zero.
// Rounding must be to nearest (motions/base/floating_point_guard.h).
//
// The bounds are rounded too, by a relative 2^-53 per operation. The user of a bound must therefore inflate
// it once (`inflation`).

#include <cmath>

#include "motions/base/floating_point.h"

namespace kds {

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

}  // namespace kds
