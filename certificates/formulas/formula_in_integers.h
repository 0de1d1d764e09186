#pragma once
// A function of beads in integers. A bound of the coefficients in lengths, and the width of the beads'
// control points, determine how long the coefficients are. Most fit into integers of fixed width. Longer ones
// are evaluated modulo as many primes as needed, and those longer than the primes allow are evaluated in
// integers of unlimited length. Exact. Compiled once for Curves in 1 to 3 dimensions and LiftedCurves in 2
// and 3 dimensions; `C` stands for these.
//
// If the control points differ wildly in size, the function is wide (wide_polynomial.h): its coefficients are
// formed on demand, to the requested precision.

#include "certificates/exact/exact_polynomial.h"
#include "certificates/formulas/bead_function.h"
#include "motions/curves/curves.h"

namespace kds {

class Dyadic;

/// The number of bits in a length from which a function is wide: two doubles with 2^54 between them.
/// Lengths of ordinary input are shorter, including decimal numbers and rounded numbers with nearly zero
/// values among them.
inline constexpr int wide_length_bits = 160;

/// Returns the function, times a positive number.
template <class C>
[[nodiscard]] ExactPolynomial exact_function(const BeadFunction& function, const C& curves);
/// Returns the sign at a time in [0,1]: 1, 0 or -1.
template <class C>
[[nodiscard]] int exact_sign_at(const BeadFunction& function, const C& curves, const Dyadic& time);

}  // namespace kds
