#pragma once
// A number by as many leading digits as are asked for, with a proved bound of what is left out; without a
// limit it is exact. For what 126 bits (leading_digits.h) do not tell. Bits that the bound makes meaningless
// are not kept.

#include <cstddef>
#include <cstdint>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/leading_digits.h"

namespace kds {

class LongDigits {
 public:
  static constexpr std::size_t unlimited = static_cast<std::size_t>(-1);

  /// Zero.
  explicit LongDigits(std::size_t most_bits = unlimited) : most_bits_(most_bits) {}
  LongDigits(const Integer& value, std::size_t most_bits);
  /// |x - value 2^exponent| <= error 2^exponent, error below 2^63.
  LongDigits(Integer value, std::uint64_t error, std::int64_t exponent, std::size_t most_bits);
  explicit LongDigits(const LeadingDigits& number);
  /// All numbers between two, from 0 on.
  [[nodiscard]] static LongDigits between(const Integer& low, const Integer& high, std::size_t most_bits);

  [[nodiscard]] LeadingDigits leading_digits() const;

  /// 1 or -1 if that is the sign for certain, else 0.
  [[nodiscard]] int certain_sign() const;
  [[nodiscard]] bool is_zero() const { return value_ == 0 && error_ == 0; }
  /// So many leading binary digits are right, or it is exact.
  [[nodiscard]] bool has_digits(std::size_t digits) const;
  /// |value - number() 2^exponent()| <= error() 2^exponent()
  [[nodiscard]] const Integer& number() const { return value_; }
  [[nodiscard]] std::uint64_t error() const { return error_; }
  [[nodiscard]] std::int64_t exponent() const { return exponent_; }
  void scale(std::int64_t power) { exponent_ += power; }

  LongDigits& operator+=(const LongDigits& other);
  LongDigits& operator*=(const LongDigits& other);

 private:
  /// By how many of so many bits it can be shifted up and still have room.
  [[nodiscard]] std::size_t room(std::size_t wanted) const;
  void shift_down(std::size_t bits);
  void cut();

  Integer value_ = 0;
  std::uint64_t error_ = 0;  // of 61 bits between operations
  std::int64_t exponent_ = 0;
  std::size_t most_bits_;
};

/// Of 64 bits, roughly.
[[nodiscard]] inline std::size_t limbs_of(const LongDigits& x) { return mpz_size(x.number().data()) + 1; }

/// a += b c
inline void add_product(LongDigits& a, LongDigits b, const LongDigits& c) { a += (b *= c); }

}  // namespace kds
