#pragma once
// Whole numbers and fractions without a width: GMP's C++ classes, and what these lack. Exact.
//
// Operators return expressions that refer to their operands: write the type of a result, not `auto`.
// Fractions are in lowest terms; one of two whole numbers is made by fraction(), which sees to that.

#include <gmpxx.h>

#include <cstddef>

namespace kds {

using Integer = mpz_class;
using Rational = mpq_class;

static_assert(sizeof(long) == sizeof(long long), "GMP takes numbers of 64 bits as long");

/// The denominator is not zero.
[[nodiscard]] inline Rational fraction(const Integer& numerator, const Integer& denominator) {
  Rational result(numerator, denominator);
  result.canonicalize();
  return result;
}
[[nodiscard]] inline Integer numerator(const Rational& a) { return a.get_num(); }
[[nodiscard]] inline Integer denominator(const Rational& a) { return a.get_den(); }

/// How many bits the number has in size, 1 for zero.
[[nodiscard]] inline std::size_t bit_length(const Integer& a) { return mpz_sizeinbase(a.get_mpz_t(), 2); }

}  // namespace kds
