#pragma once
// Ball arithmetic, as in leading_digits.h, with a fixed number of 64-bit words and no allocation. It fills
// the gap between LeadingDigits and LongDigits. Exponents count words, so aligning two numbers moves whole
// words. If a product is added to a sum, the part of the product below the sum's last word is not computed.
// Numbers are exact while they fit. All operations use integers.

#include <gmp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/long_digits.h"
#include "motions/numbers/modular.h"

namespace kds {

/// A ball: |value - (+-limbs) 2^(64 exponent)| <= error 2^(64 exponent).
template <int Most>
class FixedDigits {
  static_assert(GMP_NUMB_BITS == 64 && sizeof(mp_limb_t) == 8, "GMP's words have 64 bits");

 public:
  FixedDigits() {}  // zero
  [[nodiscard]] static FixedDigits of(long long x);
  explicit FixedDigits(const Integer& x) { set(x, 0, 0); }
  explicit FixedDigits(const LongDigits& x) { set(x.number(), x.error(), x.exponent()); }
  /// Returns a ball that contains every number between two bounds, 0 <= low <= high.
  [[nodiscard]] static FixedDigits between(const Integer& low, const Integer& high);
  [[nodiscard]] LongDigits long_digits() const;

  /// Returns 1 or -1 if that is certainly the sign, else 0.
  [[nodiscard]] int certain_sign() const {
    return size_ > 1 || (size_ == 1 && limbs_[0] > error_) ? (negative_ ? -1 : 1) : 0;
  }
  /// Returns whether the number is certainly 0.
  [[nodiscard]] bool is_zero() const { return size_ == 0 && error_ == 0; }

  FixedDigits& operator+=(const FixedDigits& other);
  FixedDigits& operator-=(const FixedDigits& other) { return *this += -other; }
  FixedDigits& operator*=(const FixedDigits& other) { return *this = product(*this, other, lowest); }
  FixedDigits& operator*=(long long factor) { return *this *= of(factor); }
  FixedDigits& operator<<=(unsigned shift);
  friend FixedDigits operator+(FixedDigits a, const FixedDigits& b) { return a += b; }
  friend FixedDigits operator-(FixedDigits a, const FixedDigits& b) { return a -= b; }
  friend FixedDigits operator-(FixedDigits a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend FixedDigits operator*(const FixedDigits& a, const FixedDigits& b) { return product(a, b, lowest); }

  /// a += b c
  friend void add_product(FixedDigits& a, const FixedDigits& b, const FixedDigits& c) {
    a += product(b, c, a.last_word());
  }
  /// Returns the approximate length of x in 64-bit limbs.
  friend std::size_t limbs_of(const FixedDigits& x) { return static_cast<std::size_t>(x.size_) + 1; }

 private:
  static constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min() / 4;
  static constexpr int error_bits = 62;

  /// Returns a b where digits below 2^(64 floor) do not matter and may be dropped.
  [[nodiscard]] static FixedDigits product(const FixedDigits& a, const FixedDigits& b, std::int64_t floor);
  void set(const Integer& number, std::uint64_t error, std::int64_t exponent);

  /// Returns the exponent (in words) below which a sum keeps nothing of what is added to it.
  [[nodiscard]] std::int64_t last_word() const {
    return is_zero() ? lowest : error_ != 0 ? exponent_ : exponent_ + size_ - Most;
  }
  void strip() {
    while (size_ > 0 && limbs_[static_cast<std::size_t>(size_) - 1] == 0) --size_;
  }
  /// Drops the lowest words.
  void drop(std::int64_t words);
  /// Converts a bound from units of one word to units `words` words larger, rounding up.
  [[nodiscard]] static Wide over(Wide bound, std::int64_t words) {
    return words == 0 || bound == 0 ? bound : words == 1 ? (bound >> 64U) + 1 : 1;
  }
  /// Returns an upper bound of |x| * error in units of 2^(64 words), with words >= (number of words of
  /// x) - 1.
  [[nodiscard]] static Wide times(const FixedDigits& x, std::uint64_t error, std::int64_t words) {
    if (x.size_ == 0 || error == 0) return 0;
    return over((Wide{x.limbs_[static_cast<std::size_t>(x.size_) - 1]} + 1) * error, words - (x.size_ - 1));
  }

  std::int64_t exponent_ = 0;
  std::uint64_t error_ = 0;
  int size_ = 0;
  bool negative_ = false;
  std::array<mp_limb_t, static_cast<std::size_t>(Most)> limbs_;  // lowest first; the highest is not 0
};

template <int Most>
class SumOfProducts<FixedDigits<Most>> {
 public:
  SumOfProducts(const FixedDigits<Most>& a, const FixedDigits<Most>& b) : sum_(a * b) {}
  void add(const FixedDigits<Most>& a, const FixedDigits<Most>& b) { add_product(sum_, a, b); }
  [[nodiscard]] FixedDigits<Most> value() && { return sum_; }

 private:
  FixedDigits<Most> sum_;
};

extern template class FixedDigits<4>;
extern template class FixedDigits<8>;
extern template class FixedDigits<16>;
extern template class FixedDigits<32>;

}  // namespace kds
