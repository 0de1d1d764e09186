#pragma once
// Exact fractions that share no code with GMP, which kds uses.

#include <CGAL/boost_mp.h>

#include <boost/multiprecision/cpp_int.hpp>

namespace oracle {

/// Operators return values, not expressions, as CGAL's templates expect.
using Rational = boost::multiprecision::number<boost::multiprecision::cpp_rational::backend_type,
                                               boost::multiprecision::et_off>;

}  // namespace oracle
