#pragma once
// Exact numbers for judges: Boost's, which share no code with GMP, the product's. A mistake in one of the two
// libraries, or in their use, then shows as a difference.

#include <boost/multiprecision/cpp_int.hpp>

#include "motions/numbers/exact_number.h"

namespace kds::test::second {

// Operators return values, not expressions.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int::backend_type,
                                              boost::multiprecision::et_off>;
using Rational = boost::multiprecision::number<boost::multiprecision::cpp_rational::backend_type,
                                               boost::multiprecision::et_off>;

/// Returns one of the product's numbers, handed over as hexadecimal text.
[[nodiscard]] inline Integer of(const kds::Integer& x) {
  const kds::Integer size = abs(x);
  const Integer result("0x" + size.get_str(16));
  return sgn(x) < 0 ? Integer(-result) : result;
}
[[nodiscard]] inline Rational of(const kds::Rational& x) {
  return Rational(of(numerator(x)), of(denominator(x)));
}

}  // namespace kds::test::second
