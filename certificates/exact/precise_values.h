#pragma once
// Values of wide polynomials, and signs of their coefficients on a part of the step, to as many digits as an
// answer takes: first by 126 bits, then by twice as many and again, in the end by all. Exact.

#include "certificates/exact/halves.h"
#include "certificates/exact/wide_polynomial.h"
#include "motions/numbers/long_digits.h"

namespace kds {

/// The value at u, to at least so many leading binary digits, or exact.
[[nodiscard]] LongDigits value_at(const WidePolynomial& polynomial, const Dyadic& u, std::size_t digits);

/// The sign all over [lower, upper] if as many digits tell as the interval has, else 0.
[[nodiscard]] int sign_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper);

/// The polynomial as seen on [lower, upper], ends of one scale, by so many leading digits.
[[nodiscard]] Halves seen_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                                  std::size_t bits);

/// Sign changes of the polynomial as seen on [lower, upper]: least and most are the same, or both at least
/// 2, where no more is asked.
[[nodiscard]] Variations exact_variations(const WidePolynomial& polynomial, const Dyadic& lower,
                                          const Dyadic& upper);

/// The same where leading digits do not tell: from so many bits on, which become those that told.
[[nodiscard]] Variations variations_closely(const WidePolynomial& polynomial, const Dyadic& lower,
                                            const Dyadic& upper, std::size_t& bits);

}  // namespace kds
