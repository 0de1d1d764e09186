#pragma once
// A function of beads on whole numbers. The bound of its coefficients in lengths tells how long they are at
// the width of these beads' control points: most fit into numbers of a fixed width. Longer ones are evaluated
// modulo as many primes as they ask for; where they are longer than the primes reach, on whole numbers
// outright. Exact. Compiled once for Curves in 1 to 3 dimensions and LiftedCurves in 2 and 3, which `C`
// stands for.
//
// Where the control points themselves are of wildly different size, the function is wide (wide_polynomial.h):
// its coefficients are formed when they are asked for, and as precisely.

#include "certificates/exact/exact_polynomial.h"
#include "certificates/formulas/bead_function.h"
#include "motions/curves/curves.h"

namespace kds {

class Dyadic;

/// Lengths of so many bits make a function wide: two doubles and 2^54 between them. Those of ordinary input,
/// decimal numbers or rounded ones with what is nearly zero among them, are shorter.
inline constexpr int wide_length_bits = 160;

/// Times a positive number.
template <class C>
[[nodiscard]] ExactPolynomial exact_function(const BeadFunction& function, const C& curves);
/// 1, 0 or -1 at a time of [0,1].
template <class C>
[[nodiscard]] int exact_sign_at(const BeadFunction& function, const C& curves, const Dyadic& time);

}  // namespace kds
