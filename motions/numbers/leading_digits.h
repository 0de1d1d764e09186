#pragma once
// Ball arithmetic with at most 126 bits: a number is stored as its leading bits, an exponent without limit,
// and a proved bound on the truncation error in units of the last bit. Whole numbers stay exact while they
// fit into 126 bits. All operations use integers, so the results depend neither on a range of exponents nor
// on a rounding mode. If the sign is uncertain, ask the exact number.

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

  /// Returns 1 or -1 if that is certainly the sign, else 0.
  [[nodiscard]] int certain_sign() const { return magnitude <= error ? 0 : negative ? -1 : 1; }
  /// Returns whether the number is certainly 0.
  [[nodiscard]] bool is_zero() const { return magnitude == 0 && error == 0; }
  /// Returns an exponent with |value| < 2^top_bit(). Not meaningful for zero.
  [[nodiscard]] std::int64_t top_bit() const;

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
