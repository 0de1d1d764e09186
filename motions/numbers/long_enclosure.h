#pragma once
// A number by as many leading digits as are asked for, with a proved bound of what is left out; without a
// limit it is exact. For what 126 bits (enclosure.h) do not tell.

#include <cstddef>
#include <cstdint>
#include <utility>

#include "motions/numbers/enclosure.h"
#include "motions/numbers/exact_number.h"

namespace kds {

class LongEnclosure {
 public:
  static constexpr std::size_t unlimited = static_cast<std::size_t>(-1);

  /// Zero.
  explicit LongEnclosure(std::size_t most_bits = unlimited) : most_bits_(most_bits) {}
  LongEnclosure(Integer value, std::size_t most_bits) : value_(std::move(value)), most_bits_(most_bits) {
    cut();
  }
  explicit LongEnclosure(const Enclosure& number);

  /// 1 or -1 if that is the sign for certain, else 0.
  [[nodiscard]] int certain_sign() const;
  [[nodiscard]] bool is_zero() const { return value_ == 0 && error_ == 0; }
  /// So many leading binary digits are right, or it is exact.
  [[nodiscard]] bool has_digits(std::size_t digits) const;
  /// |value - number() 2^exponent()| <= error() 2^exponent()
  [[nodiscard]] const Integer& number() const { return value_; }
  [[nodiscard]] const Integer& error() const { return error_; }
  [[nodiscard]] std::int64_t exponent() const { return exponent_; }
  void scale(std::int64_t power) { exponent_ += power; }

  LongEnclosure& operator+=(const LongEnclosure& other);
  LongEnclosure& operator*=(const LongEnclosure& other);

 private:
  void cut();

  Integer value_ = 0, error_ = 0;
  std::int64_t exponent_ = 0;
  std::size_t most_bits_;
};

/// a += b c
inline void add_product(LongEnclosure& a, LongEnclosure b, const LongEnclosure& c) { a += (b *= c); }

}  // namespace kds
