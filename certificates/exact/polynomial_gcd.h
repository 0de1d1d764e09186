#pragma once
// Common factors of polynomials with whole coefficients, lowest first. FLINT computes the gcd; its header
// stays in the source file.
//
// The image modulo one prime gives a quick proof that there is no common factor. The degree of the gcd cannot
// fall when coefficients are reduced, as long as one leading coefficient survives, so a constant gcd modulo
// the prime is constant in whole numbers too. Any other gcd of the images proves nothing.

#include <vector>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/modular.h"

namespace kds {

/// Returns true only if the polynomials have no common factor. Leading coefficients must not be zero.
[[nodiscard]] bool certainly_coprime(const std::vector<Integer>& a, const std::vector<Integer>& b);
/// Same test for polynomials already reduced modulo the first prime. Their leading coefficients may be zero.
[[nodiscard]] bool certainly_coprime(std::vector<Residue> a, std::vector<Residue> b);

/// Returns true only if the polynomial has no factor twice. The polynomial's degree must be at least 1 and
/// its leading coefficient not zero.
[[nodiscard]] bool certainly_square_free(const std::vector<Integer>& p);
/// Same test for a polynomial already reduced modulo the first prime. Its leading coefficient may be zero.
[[nodiscard]] bool certainly_square_free(std::vector<Residue> p);

/// Modulo the first prime.
[[nodiscard]] std::vector<Residue> image_of(const std::vector<Integer>& p);

/// Returns the gcd without a common factor of its coefficients, the leading one positive; empty if both
/// polynomials are zero. Work is spent before FLINT's call, which is not interrupted.
[[nodiscard]] std::vector<Integer> polynomial_gcd(const std::vector<Integer>& a,
                                                  const std::vector<Integer>& b);

/// Returns the polynomial divided by its gcd with its derivative and by the common factor of its
/// coefficients: each root once, signs as before. Leading coefficient not zero.
[[nodiscard]] std::vector<Integer> without_repeated_factors(const std::vector<Integer>& p);

}  // namespace kds
