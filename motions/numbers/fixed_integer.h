#pragma once
// Integers modulo 2^384, stored in place, with operations of constant cost. A result is exact if it is below
// 2^383 in size, whatever the intermediate values were. Most functions of beads fit, so they need neither
// integers of unlimited length nor residues.

#include <array>
#include <cstddef>
#include <cstdint>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/exact_number.h"

namespace kds {

class FixedInteger {
 public:
  static constexpr int bits = 384;

  FixedInteger() = default;  // zero
  explicit FixedInteger(long long x) {
    limbs_.fill(x < 0 ? ~std::uint64_t{0} : 0);
    limbs_[0] = static_cast<std::uint64_t>(x);
  }

  FixedInteger& operator+=(const FixedInteger& other);
  FixedInteger& operator-=(const FixedInteger& other);
  FixedInteger& operator*=(long long factor);
  FixedInteger& operator<<=(unsigned shift);
  void add_product(const FixedInteger& a, const FixedInteger& b);

  friend FixedInteger operator+(FixedInteger a, const FixedInteger& b) { return a += b; }
  friend FixedInteger operator-(FixedInteger a, const FixedInteger& b) { return a -= b; }
  friend FixedInteger operator-(const FixedInteger& a) { return FixedInteger(0) - a; }
  friend FixedInteger operator*(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger product;
    product.add_product(a, b);
    return product;
  }

  /// Returns the value between -2^383 and 2^383.
  [[nodiscard]] Integer whole_number() const;

 private:
  static constexpr std::size_t count = bits / 64;

  [[nodiscard]] bool is_negative() const { return limbs_.back() >> 63U != 0; }
  /// Returns the number of lowest limbs that matter: all higher limbs repeat the sign.
  [[nodiscard]] std::size_t significant() const;

  std::array<std::uint64_t, count> limbs_{};  // two's complement, lowest first
};

template <>
class SumOfProducts<FixedInteger> {
 public:
  SumOfProducts(const FixedInteger& a, const FixedInteger& b) { sum_.add_product(a, b); }
  void add(const FixedInteger& a, const FixedInteger& b) { sum_.add_product(a, b); }
  [[nodiscard]] const FixedInteger& value() && { return sum_; }

 private:
  FixedInteger sum_;
};

}  // namespace kds
