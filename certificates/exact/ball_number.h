#pragma once
// Ball arithmetic: numbers with proved bounds on their errors, which are Arb's (arb_t of FLINT 3). Only
// ball_number.cpp includes Arb's header, because its macros would reach every file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "motions/numbers/exact_number.h"

namespace kds {

/// A midpoint with a limited number of bits, and a radius that bounds its distance from the exact value.
/// Whole numbers stay exact while they fit. Exponents have no limit. The result of an operation has the
/// precision of the less precise operand.
class BallNumber {
 public:
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  /// The precision of first attempts, which decide most signs.
  static constexpr std::size_t first_bits = 128;

  /// Constructs zero.
  explicit BallNumber(std::size_t bits = unlimited);
  BallNumber(const Integer& value, std::size_t bits);
  [[nodiscard]] static BallNumber of(std::int64_t value, std::size_t bits);
  /// Returns a ball that contains every number between two bounds, 0 <= low <= high.
  [[nodiscard]] static BallNumber between(const Integer& low, const Integer& high, std::size_t bits);
  /// Returns a ball around `value` whose radius is 2^log_of_radius.
  [[nodiscard]] static BallNumber around(const Integer& value, std::int64_t log_of_radius, std::size_t bits);
  BallNumber(const BallNumber& other);
  BallNumber(BallNumber&& other) noexcept;
  BallNumber& operator=(const BallNumber& other);
  BallNumber& operator=(BallNumber&& other) noexcept;
  ~BallNumber();

  /// Returns the number with another precision.
  [[nodiscard]] BallNumber rounded(std::size_t bits) const;
  /// Returns 1 or -1 if that is certainly the sign, else 0.
  [[nodiscard]] int certain_sign() const;
  /// Returns whether the number is certainly 0.
  [[nodiscard]] bool is_zero() const;
  /// Returns whether the number is exact or at least `digits` leading binary digits are correct.
  [[nodiscard]] bool has_digits(std::size_t digits) const;
  /// Returns an exponent with |value| < 2^top_bit(), at most one too large. Not meaningful for zero.
  [[nodiscard]] std::int64_t top_bit() const;
  /// Returns the exponent of the midpoint's lowest bit. Not meaningful for zero.
  [[nodiscard]] std::int64_t lowest_bit() const;
  /// Returns an exponent with radius < 2^exponent, or nothing if the number is exact.
  [[nodiscard]] std::optional<std::int64_t> radius_bit() const;
  /// Returns a whole number of units of 2^unit, and raises `error` to a bound of its distance from the value
  /// in these units.
  [[nodiscard]] Integer in_units(std::int64_t unit, Integer& error) const;
  /// Multiplies by 2^power.
  void scale(std::int64_t power);

  BallNumber& operator+=(const BallNumber& other);
  BallNumber& operator-=(const BallNumber& other);
  BallNumber& operator*=(const BallNumber& other);
  BallNumber& operator*=(long long factor);
  BallNumber& operator<<=(unsigned shift) {
    scale(shift);
    return *this;
  }
  friend BallNumber operator+(BallNumber a, const BallNumber& b) { return std::move(a += b); }
  friend BallNumber operator-(BallNumber a, const BallNumber& b) { return std::move(a -= b); }
  friend BallNumber operator*(BallNumber a, const BallNumber& b) { return std::move(a *= b); }
  friend BallNumber operator-(BallNumber a);
  /// Adds a b to the sum.
  friend void add_product(BallNumber& sum, const BallNumber& a, const BallNumber& b);
  /// Returns the approximate length in 64-bit words.
  friend std::size_t limbs_of(const BallNumber& x);

 private:
  /// Reduces the precision to that of the other operand.
  void share(std::size_t bits);

  std::array<std::uint64_t, 6> arb_;  // an arb_struct
  std::size_t bits_;
};

template <>
class SumOfProducts<BallNumber> {
 public:
  SumOfProducts(const BallNumber& a, const BallNumber& b) : sum_(a * b) {}
  void add(const BallNumber& a, const BallNumber& b) { add_product(sum_, a, b); }
  [[nodiscard]] BallNumber value() && { return std::move(sum_); }

 private:
  BallNumber sum_;
};

}  // namespace kds
