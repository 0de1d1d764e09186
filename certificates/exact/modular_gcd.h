#pragma once
// A quick proof that two polynomials have no common factor: their gcd modulo a 61-bit prime. The degree of
// the gcd cannot fall when the coefficients are reduced, as long as a leading coefficient survives; so a
// constant there is a constant everywhere. The other answer proves nothing.

#include <vector>

#include "motions/numbers/exact_number.h"

namespace kds {

/// True only if the polynomials, lowest coefficient first, have no common factor. Leading coefficients not
/// zero.
[[nodiscard]] bool certainly_coprime(const std::vector<Integer>& a, const std::vector<Integer>& b);

/// True only if the polynomial has no factor twice. Degree at least 1, leading coefficient not zero.
[[nodiscard]] bool certainly_square_free(const std::vector<Integer>& p);

}  // namespace kds
