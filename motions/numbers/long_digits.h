#pragma once
// Ball arithmetic with a chosen number of leading bits: a number with a proved bound on its truncation error.
// It is exact if there is no limit on the bits. It serves signs that the 126 bits of leading_digits.h do not
// decide. Bits that the error bound makes meaningless are dropped.

#include <cstddef>
#include <cstdint>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/leading_digits.h"

namespace kds {

class LongDigits {
 public:
  static constexpr std::size_t unlimited = static_cast<std::size_t>(-1);

  /// Constructs zero.
  explicit LongDigits(std::size_t most_bits = unlimited) : most_bits_(most_bits) {}
  LongDigits(const Integer& value, std::size_t most_bits);
  /// Constructs a ball: |x - value 2^exponent| <= error 2^exponent, with error < 2^63.
  LongDigits(Integer value, std::uint64_t error, std::int64_t exponent, std::size_t most_bits);
  explicit LongDigits(const LeadingDigits& number);
  /// Returns a ball that contains every number between two bounds, 0 <= low <= high.
  [[nodiscard]] static LongDigits between(const Integer& low, const Integer& high, std::size_t most_bits);

  [[nodiscard]] LeadingDigits leading_digits() const;

  /// Returns 1 or -1 if that is certainly the sign, else 0.
  [[nodiscard]] int certain_sign() const;
  [[nodiscard]] bool is_zero() const { return value_ == 0 && error_ == 0; }
  /// Returns whether the number is exact or at least `digits` leading binary digits are correct.
  [[nodiscard]] bool has_digits(std::size_t digits) const;
  /// The ball: |value - number() 2^exponent()| <= error() 2^exponent().
  [[nodiscard]] const Integer& number() const { return value_; }
  [[nodiscard]] std::uint64_t error() const { return error_; }
  [[nodiscard]] std::int64_t exponent() const { return exponent_; }
  void scale(std::int64_t power) { exponent_ += power; }

  LongDigits& operator+=(const LongDigits& other);
  LongDigits& operator*=(const LongDigits& other);

 private:
  /// Returns by how many bits, at most `wanted`, the value can be shifted up within its limits.
  [[nodiscard]] std::size_t room(std::size_t wanted) const;
  void shift_down(std::size_t bits);
  void cut();

  Integer value_ = 0;
  std::uint64_t error_ = 0;  // at most 61 bits between operations
  std::int64_t exponent_ = 0;
  std::size_t most_bits_;
};

/// Returns the approximate length of x in 64-bit limbs.
[[nodiscard]] inline std::size_t limbs_of(const LongDigits& x) {
  return mpz_size(x.number().get_mpz_t()) + 1;
}

/// a += b c
inline void add_product(LongDigits& a, LongDigits b, const LongDigits& c) { a += (b *= c); }

}  // namespace kds
