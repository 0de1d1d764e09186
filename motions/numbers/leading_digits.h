#pragma once
// A number by its leading digits: 126 bits at most, an exponent of any size, and a proved bound of what is
// left out, in units of the last bit. Numbers that are whole to begin with and need no more bits stay exact.
// All in integers, so that no range and no rounding mode matters. A sign that it does not tell is to be asked
// of the exact number.

#include <cstdint>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/modular.h"

namespace kds {

struct LeadingDigits {
  static constexpr int most_bits = 126;

  Wide magnitude = 0;  ///< |value - (+-magnitude) 2^exponent| <= error 2^exponent
  std::int64_t exponent = 0;
  std::uint64_t error = 0;
  bool negative = false;

  [[nodiscard]] static LeadingDigits of(long long x);
  [[nodiscard]] static LeadingDigits of(const Integer& x);

  /// 1 or -1 if that is the sign for certain, else 0.
  [[nodiscard]] int certain_sign() const { return magnitude <= error ? 0 : negative ? -1 : 1; }
  /// The number is 0 for certain.
  [[nodiscard]] bool is_zero() const { return magnitude == 0 && error == 0; }
  /// The size is below 2^top_bit(); of 0 nothing is told.
  [[nodiscard]] std::int64_t top_bit() const;
  /// Roughly, and the power of two that goes with it.
  [[nodiscard]] double rough_fraction(std::int64_t& power) const;

  LeadingDigits& operator+=(const LeadingDigits& other);
  LeadingDigits& operator-=(const LeadingDigits& other) { return *this += -other; }
  LeadingDigits& operator*=(const LeadingDigits& other) { return *this = *this * other; }
  LeadingDigits& operator*=(long long factor) { return *this = *this * of(factor); }
  LeadingDigits& operator<<=(unsigned shift) {
    exponent += shift;
    return *this;
  }
  friend LeadingDigits operator+(LeadingDigits a, const LeadingDigits& b) { return a += b; }
  friend LeadingDigits operator-(LeadingDigits a, const LeadingDigits& b) { return a -= b; }
  friend LeadingDigits operator-(LeadingDigits a) {
    a.negative = !a.negative;
    return a;
  }
  friend LeadingDigits operator*(const LeadingDigits& a, const LeadingDigits& b);
};

}  // namespace kds
