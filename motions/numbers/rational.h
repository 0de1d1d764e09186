#pragma once
// Fractions of whole numbers: GMP's, as values, in lowest terms. Exact.

#include <gmp.h>

#include <compare>
#include <iosfwd>
#include <string>

#include "motions/numbers/integer.h"

namespace kds {

class Rational {
 public:
  Rational() { mpq_init(value_); }
  Rational(Word auto value) : Rational(Integer(value)) {}
  Rational(const Integer& value) : Rational() { mpq_set_z(value_, value.data()); }
  /// The double itself, which must be finite.
  Rational(double value) : Rational() { mpq_set_d(value_, value); }
  /// The denominator is not zero.
  Rational(const Integer& numerator, const Integer& denominator);
  explicit Rational(mpq_srcptr value) : Rational() { mpq_set(value_, value); }
  Rational(const Rational& other) : Rational() { mpq_set(value_, other.value_); }
  Rational(Rational&& other) noexcept : Rational() { mpq_swap(value_, other.value_); }
  Rational& operator=(const Rational& other) {
    mpq_set(value_, other.value_);
    return *this;
  }
  Rational& operator=(Rational&& other) noexcept {
    mpq_swap(value_, other.value_);
    return *this;
  }
  ~Rational() { mpq_clear(value_); }

  /// For GMP's functions.
  [[nodiscard]] mpq_ptr data() { return value_; }
  [[nodiscard]] mpq_srcptr data() const { return value_; }

  /// Positive, 0 or negative.
  [[nodiscard]] int compare(const Rational& other) const { return mpq_cmp(value_, other.value_); }
  [[nodiscard]] int sign() const { return mpq_sgn(value_); }
  /// Rounded towards zero.
  [[nodiscard]] explicit operator double() const { return mpq_get_d(value_); }
  /// Decimal digits, and after a slash those of the denominator unless it is 1.
  [[nodiscard]] std::string str() const;

  Rational& operator+=(const Rational& other) {
    mpq_add(value_, value_, other.value_);
    return *this;
  }
  Rational& operator-=(const Rational& other) {
    mpq_sub(value_, value_, other.value_);
    return *this;
  }
  Rational& operator*=(const Rational& other) {
    mpq_mul(value_, value_, other.value_);
    return *this;
  }
  /// The other is not zero.
  Rational& operator/=(const Rational& other) {
    mpq_div(value_, value_, other.value_);
    return *this;
  }

  friend Rational operator-(Rational a) {
    mpq_neg(a.value_, a.value_);
    return a;
  }
  friend Rational operator+(const Rational& a, const Rational& b) {
    Rational sum;
    mpq_add(sum.value_, a.value_, b.value_);
    return sum;
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    Rational difference;
    mpq_sub(difference.value_, a.value_, b.value_);
    return difference;
  }
  friend Rational operator*(const Rational& a, const Rational& b) {
    Rational product;
    mpq_mul(product.value_, a.value_, b.value_);
    return product;
  }
  friend Rational operator/(const Rational& a, const Rational& b) {
    Rational quotient;
    mpq_div(quotient.value_, a.value_, b.value_);
    return quotient;
  }

  friend bool operator==(const Rational& a, const Rational& b) { return mpq_equal(a.value_, b.value_) != 0; }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) { return a.compare(b) <=> 0; }
  friend std::ostream& operator<<(std::ostream& out, const Rational& value);

 private:
  mpq_t value_;
};

[[nodiscard]] inline Integer numerator(const Rational& a) { return Integer(mpq_numref(a.data())); }
[[nodiscard]] inline Integer denominator(const Rational& a) { return Integer(mpq_denref(a.data())); }
[[nodiscard]] inline Rational abs(Rational a) {
  mpq_abs(a.data(), a.data());
  return a;
}

}  // namespace kds
