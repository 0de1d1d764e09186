#pragma once
// Values of wide polynomials, and sign changes on parts of the step, computed by ball arithmetic of
// increasing precision: first 126 bits, then twice as many at each attempt, finally all bits. Exact.

#include "certificates/exact/halves.h"
#include "certificates/exact/wide_polynomial.h"
#include "motions/numbers/long_digits.h"

namespace kds {

/// Returns the value at u, exact or with at least `digits` correct leading binary digits.
[[nodiscard]] LongDigits value_at(const WidePolynomial& polynomial, const Dyadic& u, std::size_t digits);

/// Returns the sign on [lower, upper] if about as many digits as the interval has decide it, else 0.
[[nodiscard]] int sign_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper);

/// Returns the polynomial restricted to [lower, upper], with numbers of `bits` leading bits. The ends must
/// have the same scale.
[[nodiscard]] Halves seen_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                                  std::size_t bits);

/// Counts the sign changes of the polynomial restricted to [lower, upper]. In the result least == most, or
/// both are at least 2, since callers need no more.
[[nodiscard]] Variations exact_variations(const WidePolynomial& polynomial, const Dyadic& lower,
                                          const Dyadic& upper);

/// Does the same if leading digits do not decide. Starts with numbers of `bits` bits, and sets `bits` to the
/// number that decided.
[[nodiscard]] Variations variations_closely(const WidePolynomial& polynomial, const Dyadic& lower,
                                            const Dyadic& upper, std::size_t& bits);

}  // namespace kds
