#pragma once
// A number by its leading digits, as in leading_digits.h, of so many words of 64 bits: lengths between those
// of LeadingDigits and of LongDigits, without an allocation. Exponents count words, so that numbers are
// aligned by moving whole ones, and of a product that is added to a sum what lies below the sum's last word
// is not multiplied out. Where all fits numbers are exact. All in integers.

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

/// |value - (+-limbs) 2^(64 exponent)| <= error 2^(64 exponent)
template <int Most>
class FixedDigits {
  static_assert(GMP_NUMB_BITS == 64 && sizeof(mp_limb_t) == 8, "GMP's words have 64 bits");

 public:
  FixedDigits() {}  // zero
  [[nodiscard]] static FixedDigits of(long long x);
  explicit FixedDigits(const Integer& x) { set(x, 0, 0); }
  explicit FixedDigits(const LongDigits& x) { set(x.number(), x.error(), x.exponent()); }
  /// All numbers between two, from 0 on.
  [[nodiscard]] static FixedDigits between(const Integer& low, const Integer& high);
  [[nodiscard]] LongDigits long_digits() const;

  /// 1 or -1 if that is the sign for certain, else 0.
  [[nodiscard]] int certain_sign() const {
    return size_ > 1 || (size_ == 1 && limbs_[0] > error_) ? (negative_ ? -1 : 1) : 0;
  }
  /// The number is 0 for certain.
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
  /// Of 64 bits, roughly.
  friend std::size_t limbs_of(const FixedDigits& x) { return static_cast<std::size_t>(x.size_) + 1; }

 private:
  static constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min() / 4;
  static constexpr int error_bits = 62;

  /// Of what is left where digits below 2^(64 floor) do not matter.
  [[nodiscard]] static FixedDigits product(const FixedDigits& a, const FixedDigits& b, std::int64_t floor);
  void set(const Integer& number, std::uint64_t error, std::int64_t exponent);

  /// The exponent below which nothing is kept of what is added.
  [[nodiscard]] std::int64_t last_word() const {
    return is_zero() ? lowest : error_ != 0 ? exponent_ : exponent_ + size_ - Most;
  }
  void strip() {
    while (size_ > 0 && limbs_[static_cast<std::size_t>(size_) - 1] == 0) --size_;
  }
  /// Leaves out the lowest words.
  void drop(std::int64_t words);
  /// What a bound of 2^64 units a word and more comes to, rounded up.
  [[nodiscard]] static Wide over(Wide bound, std::int64_t words) {
    return words == 0 || bound == 0 ? bound : words == 1 ? (bound >> 64U) + 1 : 1;
  }
  /// |x| times an error, in units of 2^(64 words), at least as many words as x has but one.
  [[nodiscard]] static Wide times(const FixedDigits& x, std::uint64_t error, std::int64_t words) {
    if (x.size_ == 0 || error == 0) return 0;
    return over((Wide{x.limbs_[static_cast<std::size_t>(x.size_) - 1]} + 1) * error, words - (x.size_ - 1));
  }

  std::int64_t exponent_ = 0;
  std::uint64_t error_ = 0;
  int size_ = 0;
  bool negative_ = false;
  std::array<mp_limb_t, static_cast<std::size_t>(Most)> limbs_;  // lowest first, the last of them not 0
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
