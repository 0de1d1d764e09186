#pragma once
// Greatest common divisors of polynomials with whole coefficients, lowest first, by their images modulo
// primes of 61 bits (Brown's algorithm): numbers grow no longer than those of the result, where Euclid's
// algorithm on whole numbers makes them grow at every step. Exact: a candidate counts only once it has
// divided both.
//
// Of one prime's image alone follows a quick proof that there is no common factor. The degree of the gcd
// cannot fall when coefficients are reduced, as long as one leading coefficient survives; so a constant there
// is a constant everywhere. The other answer proves nothing.

#include <optional>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/modular.h"

namespace kds {

/// True only if the polynomials have no common factor. Leading coefficients not zero.
[[nodiscard]] bool certainly_coprime(const std::vector<Integer>& a, const std::vector<Integer>& b);
/// The same by their images, whose leading coefficients may be zero.
[[nodiscard]] bool certainly_coprime(std::vector<Residue> a, std::vector<Residue> b);

/// True only if the polynomial has no factor twice. Degree at least 1, leading coefficient not zero.
[[nodiscard]] bool certainly_square_free(const std::vector<Integer>& p);
/// The same by its image, whose leading coefficient may be zero.
[[nodiscard]] bool certainly_square_free(std::vector<Residue> p);

/// Modulo the first prime.
[[nodiscard]] std::vector<Residue> image_of(const std::vector<Integer>& p);

/// Divides by the content, the common factor of all coefficients.
void make_primitive(std::vector<Integer>& p);

/// The primitive gcd, up to its sign. Leading coefficients not zero; the other one where one is empty.
[[nodiscard]] std::vector<Integer> polynomial_gcd(std::vector<Integer> a, std::vector<Integer> b);

/// The whole quotient, if there is one. Leading coefficients not zero.
[[nodiscard]] std::optional<std::vector<Integer>> quotient(std::vector<Integer> a,
                                                           const std::vector<Integer>& b);

}  // namespace kds
