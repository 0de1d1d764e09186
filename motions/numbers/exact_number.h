#pragma once
// Exact numbers: integers and fractions of unlimited length, which are GMP's C++ classes, and dyadic
// rationals (whole numbers times powers of two). Every finite double is a dyadic rational.
//
// Operators of integers and fractions return expressions that refer to their operands, so write the type of a
// result, not `auto`. Fractions are in lowest terms. fraction() makes one of two integers and reduces it to
// lowest terms.

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "motions/numbers/bernstein.h"

namespace kds {

using Integer = mpz_class;
using Rational = mpq_class;

static_assert(sizeof(long) == sizeof(long long), "GMP takes numbers of 64 bits as long");

/// Returns numerator / denominator in lowest terms. The denominator must not be zero.
[[nodiscard]] inline Rational fraction(const Integer& numerator, const Integer& denominator) {
  Rational result(numerator, denominator);
  result.canonicalize();
  return result;
}
[[nodiscard]] inline Integer numerator(const Rational& a) { return a.get_num(); }
[[nodiscard]] inline Integer denominator(const Rational& a) { return a.get_den(); }

/// Returns the number of bits of |a|, 1 for zero.
[[nodiscard]] inline std::size_t bit_length(const Integer& a) { return mpz_sizeinbase(a.get_mpz_t(), 2); }

template <>
class SumOfProducts<Integer> {
 public:
  SumOfProducts(const Integer& a, const Integer& b) : sum_(a * b) {}
  void add(const Integer& a, const Integer& b) { mpz_addmul(sum_.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t()); }
  [[nodiscard]] Integer value() && { return std::move(sum_); }

 private:
  Integer sum_;
};

/// A finite double split into mantissa * 2^exponent. The mantissa is odd; zero is 0 * 2^0.
struct SplitDouble {
  long mantissa = 0;  // a type that GMP takes
  int exponent = 0;
};
[[nodiscard]] inline SplitDouble split(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52U) - 1);
  const int power = static_cast<int>((bits >> 52U) & 0x7ffU);
  const std::uint64_t mantissa = power == 0 ? fraction : fraction | (std::uint64_t{1} << 52U);
  if (mantissa == 0) return {};
  const int zeros = std::countr_zero(mantissa);
  const auto odd = static_cast<long>(mantissa >> static_cast<unsigned>(zeros));
  return {value < 0 ? -odd : odd, std::max(power, 1) - 1075 + zeros};
}

/// A dyadic rational, numerator / 2^exponent. Normalized: the numerator is odd or the exponent is 0.
class Dyadic {
 public:
  Dyadic() = default;
  explicit Dyadic(double value);
  Dyadic(Integer numerator, unsigned exponent);

  [[nodiscard]] const Integer& numerator() const { return numerator_; }
  [[nodiscard]] unsigned exponent() const { return exponent_; }
  [[nodiscard]] Rational rational() const;

  /// Return the largest double that is not above this number, and the smallest double that is not below it.
  [[nodiscard]] double round_down() const;
  [[nodiscard]] double round_up() const;

  [[nodiscard]] static Dyadic midpoint(const Dyadic& a, const Dyadic& b);
  [[nodiscard]] static int compare(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return compare(a, b) == 0; }
  friend bool operator<(const Dyadic& a, const Dyadic& b) { return compare(a, b) < 0; }
  friend bool operator<=(const Dyadic& a, const Dyadic& b) { return compare(a, b) <= 0; }

 private:
  Integer numerator_ = 0;
  unsigned exponent_ = 0;
};

}  // namespace kds
