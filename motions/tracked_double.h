#pragma once
// A double with a bound on its error, followed operation by operation: |value - exact| <= error. Slower than
// a filter's fixed bound and much sharper where numbers are of unlike size. Needs no assumption on range:
// overflow makes the bound infinite or a NaN, and what underflow loses is added.
//
// The bounds are rounded themselves, a relative 2^-53 an operation: whoever uses one inflates it once
// (`inflation`).

#include <cmath>

namespace kds {

struct TrackedDouble {
  static constexpr double unit_roundoff = 0x1p-53;
  static constexpr double lost_to_underflow = 0x1p-1073;
  static constexpr double inflation = 1 + 0x1p-40;  // for up to 2^10 operations in a row

  double value = 0;
  double error = 0;

  TrackedDouble& operator+=(const TrackedDouble& other) {
    value += other.value;
    error += other.error + unit_roundoff * std::abs(value) + lost_to_underflow;
    return *this;
  }
  TrackedDouble& operator-=(const TrackedDouble& other) { return *this += -other; }
  TrackedDouble operator-() const { return {-value, error}; }
  friend TrackedDouble operator+(TrackedDouble a, const TrackedDouble& b) { return a += b; }
  friend TrackedDouble operator-(TrackedDouble a, const TrackedDouble& b) { return a -= b; }
  friend TrackedDouble operator*(const TrackedDouble& a, const TrackedDouble& b) {
    const double product = a.value * b.value;
    const double carried = std::abs(a.value) * b.error + a.error * (std::abs(b.value) + b.error);
    return {product, carried + unit_roundoff * std::abs(product) + lost_to_underflow};
  }
};

}  // namespace kds
