#pragma once
// A function of beads in double with proved errors. Enclosures: what they do not decide is left to whole
// numbers (formula_in_integers.h). Compiled once for Curves in 1 to 3 dimensions and LiftedCurves in 2 and 3,
// which `C` stands for.

#include <span>

#include "certificates/filters/bounded_polynomial.h"
#include "certificates/filters/error_bound.h"
#include "certificates/formulas/bead_function.h"
#include "motions/curves/curves.h"

namespace kds {

/// A function in double with its errors, and whether all its coefficients are certainly positive.
struct BoundedFunction {
  BoundedPolynomial polynomial;
  bool positive = false;
};

/// From coefficients in scaled Bernstein form that were computed in double, and the largest length that went
/// in.
[[nodiscard]] BoundedFunction bounded_function(std::span<const double> scaled, const ErrorBound& bound,
                                               double largest_length);

/// By the formula's own filter.
template <class C>
[[nodiscard]] BoundedFunction bounded_function(const BeadFunction& function, const C& curves);
/// With errors followed operation by operation.
template <class C>
[[nodiscard]] BoundedFunction tracked_function(const BeadFunction& function, const C& curves);
/// 1 or -1 if that is the sign all over [lower, upper] for certain, without the polynomial; else 0. Of lifted
/// motion with weights always 0: they are no Bezier curves there.
template <class C>
[[nodiscard]] int certain_sign_during(const BeadFunction& function, const C& curves, double lower,
                                      double upper);

}  // namespace kds
