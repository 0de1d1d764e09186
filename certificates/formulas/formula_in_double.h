#pragma once
// A function of beads in double with proved error bounds. Cases that these do not decide are left to integers
// (formula_in_integers.h). Compiled once for Curves in 1 to 3 dimensions and LiftedCurves in 2 and 3
// dimensions; `C` stands for these.

#include <span>

#include "certificates/filters/bounded_polynomial.h"
#include "certificates/filters/error_bound.h"
#include "certificates/formulas/bead_function.h"
#include "motions/curves/curves.h"

namespace kds {

/// A function in double with its error bounds, and whether all its coefficients are certainly positive.
struct BoundedFunction {
  BoundedPolynomial polynomial;
  bool positive = false;
};

/// Takes coefficients in scaled Bernstein form computed in double, and the largest length that entered them.
[[nodiscard]] BoundedFunction bounded_function(std::span<const double> scaled, const ErrorBound& bound,
                                               double largest_length);

/// Bounds the errors by the formula's own filter.
template <class C>
[[nodiscard]] BoundedFunction bounded_function(const BeadFunction& function, const C& curves);
/// Bounds the errors operation by operation (running error bounds).
template <class C>
[[nodiscard]] BoundedFunction tracked_function(const BeadFunction& function, const C& curves);
/// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0. Does not form the
/// polynomial. For lifted motion with weights the result is always 0, because weights are not Bezier curves
/// there.
template <class C>
[[nodiscard]] int certain_sign_during(const BeadFunction& function, const C& curves, double lower,
                                      double upper);

}  // namespace kds
