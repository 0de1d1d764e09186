#pragma once
// Exact numbers for judges: Boost's, which share no code with GMP, the product's. A mistake in one of the two
// libraries, or in their use, then shows as a difference.

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <span>

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
[[nodiscard]] inline Rational of(const Dyadic& x) {
  return Rational(of(x.numerator()), Integer(1) << x.exponent());
}
/// Returns the number as the product's integer.
[[nodiscard]] inline kds::Integer as_ours(const Integer& x) { return kds::Integer(x.str()); }

/// Returns an exponent e for which all these finite numbers are multiples of 2^e.
[[nodiscard]] inline int unit_of(std::span<const double> numbers) {
  int unit = std::numeric_limits<int>::max();
  for (const double x : numbers)
    if (x != 0) unit = std::min(unit, std::ilogb(x) - 52);
  return unit == std::numeric_limits<int>::max() ? 0 : unit;
}
/// Returns x / 2^unit, which must be whole.
[[nodiscard]] inline Integer in_units(double x, int unit) {
  if (x == 0) return 0;
  const int exponent = std::ilogb(x) - 52;
  const Integer size = Integer(static_cast<long long>(std::abs(std::scalbn(x, -exponent))))
                       << static_cast<unsigned>(exponent - unit);
  return x < 0 ? Integer(-size) : size;
}

/// Returns the value at u of the Bernstein polynomial with these control numbers, divided by 2^unit and
/// multiplied by denominator(u)^degree, which makes it whole.
[[nodiscard]] inline Integer whole_value(std::span<const double> control_numbers, const Rational& u,
                                         int unit) {
  const Integer after = numerator(u), before = denominator(u) - after;
  Integer sum = 0, power = 1;  // of u's numerator
  unsigned long binomial = 1;
  const std::size_t degree = control_numbers.size() - 1;
  for (std::size_t k = 0; k <= degree; ++k, power *= after) {
    sum = sum * before + binomial * power * in_units(control_numbers[k], unit);
    binomial = binomial * (degree - k) / (k + 1);
  }
  return sum;
}
/// Returns the value at u of the Bernstein polynomial with these control numbers.
[[nodiscard]] inline Rational value(std::span<const double> control_numbers, const Rational& u) {
  const int unit = unit_of(control_numbers);
  Integer top = whole_value(control_numbers, u, unit);
  Integer bottom = pow(denominator(u), static_cast<unsigned>(control_numbers.size() - 1));
  (unit < 0 ? bottom : top) <<= static_cast<unsigned>(std::abs(unit));
  return Rational(top, bottom);
}

}  // namespace kds::test::second
