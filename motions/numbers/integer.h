#pragma once
// Integers and fractions of any size: GMP's C++ classes, and functions that these lack. Exact.
//
// Operators return expressions that refer to their operands, so write the type of a result, not `auto`.
// Fractions are in lowest terms. fraction() makes one of two integers and reduces it to lowest terms.

#include <gmpxx.h>

#include <cstddef>

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

}  // namespace kds
