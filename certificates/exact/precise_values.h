#pragma once
// Values of exact polynomials, and signs of their coefficients on a part of the step, to as many digits as an
// answer takes: first by 126 bits, then by twice as many and again, in the end by all. Exact.

#include "certificates/exact/exact_polynomial.h"
#include "motions/numbers/long_enclosure.h"

namespace kds {

/// The value at u, to at least so many leading binary digits, or exact.
[[nodiscard]] LongEnclosure value_at(const ExactPolynomial& polynomial, const Dyadic& u, std::size_t digits);

/// Sign changes of the polynomial as seen on [lower, upper]: least and most are the same, or both at least
/// 2, where no more is asked.
[[nodiscard]] Variations exact_variations(const ExactPolynomial& polynomial, const Dyadic& lower,
                                          const Dyadic& upper);

/// Where a cluster of so many roots between `from` and `to` would be by the value and the slope at `from`
/// (Newton's step for a root of that multiplicity): the number of one of `2^digits` equal parts on the way
/// from there, or -1 where that points elsewhere. No proof. `from` must not be a root.
[[nodiscard]] Integer newton_cell(const ExactPolynomial& polynomial, const Dyadic& from, const Dyadic& to,
                                  int multiplicity, unsigned digits);

}  // namespace kds
