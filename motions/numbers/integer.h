#pragma once
// Whole numbers without a width: GMP's, as values. Exact. (Wrappers of others say more in their headers than
// a file of ours takes to compile.)

#include <gmp.h>

#include <compare>
#include <concepts>
#include <iosfwd>
#include <string>
#include <utility>

namespace kds {

/// Numbers that GMP takes as they are; longer ones, which some compilers have, are refused.
template <class T>
concept SignedWord = std::signed_integral<T> && sizeof(T) <= sizeof(long);
template <class T>
concept UnsignedWord = std::unsigned_integral<T> && sizeof(T) <= sizeof(long);
template <class T>
concept Word = SignedWord<T> || UnsignedWord<T>;

class Integer {
  static_assert(sizeof(long) == sizeof(long long), "GMP takes numbers of 64 bits as long");

 public:
  Integer() { mpz_init(value_); }
  Integer(SignedWord auto value) { mpz_init_set_si(value_, value); }
  Integer(UnsignedWord auto value) { mpz_init_set_ui(value_, value); }
  /// The whole part; `value` must be finite.
  explicit Integer(double value) { mpz_init_set_d(value_, value); }
  /// In decimal digits; throws std::invalid_argument where they are none.
  explicit Integer(const std::string& digits);
  explicit Integer(mpz_srcptr value) { mpz_init_set(value_, value); }
  Integer(const Integer& other) { mpz_init_set(value_, other.value_); }
  Integer(Integer&& other) noexcept {
    mpz_init(value_);
    mpz_swap(value_, other.value_);
  }
  Integer& operator=(const Integer& other) {
    mpz_set(value_, other.value_);
    return *this;
  }
  Integer& operator=(Integer&& other) noexcept {
    mpz_swap(value_, other.value_);
    return *this;
  }
  Integer& operator=(SignedWord auto value) {
    mpz_set_si(value_, value);
    return *this;
  }
  Integer& operator=(UnsignedWord auto value) {
    mpz_set_ui(value_, value);
    return *this;
  }
  ~Integer() { mpz_clear(value_); }

  /// For GMP's functions.
  [[nodiscard]] mpz_ptr data() { return value_; }
  [[nodiscard]] mpz_srcptr data() const { return value_; }

  /// Positive, 0 or negative.
  [[nodiscard]] int compare(const Integer& other) const { return mpz_cmp(value_, other.value_); }
  [[nodiscard]] int sign() const { return mpz_sgn(value_); }
  /// Rounded towards zero; an infinity where it is beyond all doubles.
  [[nodiscard]] explicit operator double() const { return mpz_get_d(value_); }
  /// Of one that fits.
  template <std::integral To>
  requires(!std::same_as<To, bool>) [[nodiscard]] explicit operator To() const {
    return static_cast<To>(std::signed_integral<To> ? mpz_get_si(value_)
                                                    : static_cast<long>(mpz_get_ui(value_)));
  }
  /// In decimal digits.
  [[nodiscard]] std::string str() const;

  Integer& operator+=(const Integer& other) {
    mpz_add(value_, value_, other.value_);
    return *this;
  }
  Integer& operator-=(const Integer& other) {
    mpz_sub(value_, value_, other.value_);
    return *this;
  }
  Integer& operator*=(const Integer& other) {
    mpz_mul(value_, value_, other.value_);
    return *this;
  }
  Integer& operator*=(SignedWord auto factor) {
    mpz_mul_si(value_, value_, factor);
    return *this;
  }
  Integer& operator*=(UnsignedWord auto factor) {
    mpz_mul_ui(value_, value_, factor);
    return *this;
  }
  /// Rounded towards zero, and what is left of it.
  Integer& operator/=(const Integer& other) {
    mpz_tdiv_q(value_, value_, other.value_);
    return *this;
  }
  Integer& operator%=(const Integer& other) {
    mpz_tdiv_r(value_, value_, other.value_);
    return *this;
  }
  Integer& operator<<=(mp_bitcnt_t bits) {
    mpz_mul_2exp(value_, value_, bits);
    return *this;
  }
  /// Rounded down.
  Integer& operator>>=(mp_bitcnt_t bits) {
    mpz_fdiv_q_2exp(value_, value_, bits);
    return *this;
  }
  Integer& operator++() {
    mpz_add_ui(value_, value_, 1);
    return *this;
  }
  Integer& operator--() {
    mpz_sub_ui(value_, value_, 1);
    return *this;
  }

  friend Integer operator-(Integer a) {
    mpz_neg(a.value_, a.value_);
    return a;
  }
  friend Integer operator+(const Integer& a, const Integer& b) {
    Integer sum;
    mpz_add(sum.value_, a.value_, b.value_);
    return sum;
  }
  friend Integer operator+(Integer&& a, const Integer& b) { return std::move(a += b); }
  friend Integer operator-(const Integer& a, const Integer& b) {
    Integer difference;
    mpz_sub(difference.value_, a.value_, b.value_);
    return difference;
  }
  friend Integer operator-(Integer&& a, const Integer& b) { return std::move(a -= b); }
  friend Integer operator*(const Integer& a, const Integer& b) {
    Integer product;
    mpz_mul(product.value_, a.value_, b.value_);
    return product;
  }
  friend Integer operator*(const Integer& a, SignedWord auto b) {
    Integer product;
    mpz_mul_si(product.value_, a.value_, b);
    return product;
  }
  friend Integer operator*(const Integer& a, UnsignedWord auto b) {
    Integer product;
    mpz_mul_ui(product.value_, a.value_, b);
    return product;
  }
  friend Integer operator*(Word auto a, const Integer& b) { return b * a; }
  friend Integer operator/(const Integer& a, const Integer& b) {
    Integer quotient;
    mpz_tdiv_q(quotient.value_, a.value_, b.value_);
    return quotient;
  }
  friend Integer operator%(const Integer& a, const Integer& b) {
    Integer rest;
    mpz_tdiv_r(rest.value_, a.value_, b.value_);
    return rest;
  }
  friend Integer operator<<(const Integer& a, mp_bitcnt_t bits) {
    Integer shifted;
    mpz_mul_2exp(shifted.value_, a.value_, bits);
    return shifted;
  }
  friend Integer operator>>(const Integer& a, mp_bitcnt_t bits) {
    Integer shifted;
    mpz_fdiv_q_2exp(shifted.value_, a.value_, bits);
    return shifted;
  }

  friend bool operator==(const Integer& a, const Integer& b) { return mpz_cmp(a.value_, b.value_) == 0; }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) { return a.compare(b) <=> 0; }
  friend bool operator==(const Integer& a, SignedWord auto b) { return mpz_cmp_si(a.value_, b) == 0; }
  friend bool operator==(const Integer& a, UnsignedWord auto b) { return mpz_cmp_ui(a.value_, b) == 0; }
  friend std::strong_ordering operator<=>(const Integer& a, SignedWord auto b) {
    return mpz_cmp_si(a.value_, b) <=> 0;
  }
  friend std::strong_ordering operator<=>(const Integer& a, UnsignedWord auto b) {
    return mpz_cmp_ui(a.value_, b) <=> 0;
  }
  friend std::ostream& operator<<(std::ostream& out, const Integer& value);

 private:
  mpz_t value_;
};

[[nodiscard]] inline Integer abs(Integer a) {
  mpz_abs(a.data(), a.data());
  return a;
}
[[nodiscard]] Integer gcd(const Integer& a, const Integer& b);
[[nodiscard]] Integer lcm(const Integer& a, const Integer& b);
/// Of one that is not negative, rounded down.
[[nodiscard]] Integer sqrt(const Integer& a);
/// The place of the highest bit of one that is not zero, in size.
[[nodiscard]] inline std::size_t msb(const Integer& a) { return mpz_sizeinbase(a.data(), 2) - 1; }

}  // namespace kds
