#pragma once
// Evaluates a function of beads in every number type, one function at a time, over the curves of any motion.
// The formula of the function is recorded once and played, so nothing is compiled for it. The first filters
// (lanes of doubles, signs of radicals) do compile formulas: certificates/filters, certificates/search.

#include <span>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/filters/bounded_polynomial.h"
#include "certificates/formulas/bead_function.h"
#include "motions/curves/curves.h"
#include "motions/numbers/exact_number.h"

namespace kds {

// A function of beads in double with proved error bounds. Cases that these do not decide are left to
// integers. Compiled once for Curves in 1 to 3 dimensions and LiftedCurves in 2 and 3 dimensions; `C` stands
// for these.

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

// A function of beads in integers. A bound of the coefficients in lengths, and the width of the beads'
// control points, determine how long the coefficients are. Most fit into integers of fixed width. Longer ones
// are evaluated modulo as many primes as needed, and those longer than the primes allow are evaluated in
// integers of unlimited length. Exact.
//
// If the control points differ wildly in size, the function is wide (wide_polynomial.h): its coefficients are
// formed on demand, to the requested precision.

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

/// `C`: Curves or LiftedCurves.
template <class F, class C>
struct FunctionValues {
  static_assert(C::dimension >= 1 && C::dimension <= 3, "motions are of 1 to 3 dimensions");

  /// Returns the error bound of the formula in double under a motion of this degree. The bound is cached.
  [[nodiscard]] static const ErrorBound& error_bound(int degree) {
    return detail::known_formula<F, C>().error_bound(degree);
  }

  /// Bounds the errors by the function's own filter.
  [[nodiscard]] static BoundedFunction bounded(const F& function, const C& curves) {
    return with_bead_function<C>(function,
                                 [&](const BeadFunction& f) { return bounded_function(f, curves); });
  }
  /// Bounds the errors operation by operation (running error bounds).
  [[nodiscard]] static BoundedFunction tracked(const F& function, const C& curves) {
    return with_bead_function<C>(function,
                                 [&](const BeadFunction& f) { return tracked_function(f, curves); });
  }
  /// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0. Does not form the
  /// polynomial.
  [[nodiscard]] static int sign_during(const F& function, const C& curves, double lower, double upper) {
    return with_bead_function<C>(
        function, [&](const BeadFunction& f) { return certain_sign_during(f, curves, lower, upper); });
  }

  /// Returns the function in integers, times a positive number. Exact.
  [[nodiscard]] static ExactPolynomial exact(const F& function, const C& curves) {
    return with_bead_function<C>(function, [&](const BeadFunction& f) { return exact_function(f, curves); });
  }
  /// Returns the sign for curves of degree 0: 1, 0 or -1. Exact; computed in double if possible.
  [[nodiscard]] static int sign_at_rest(const F& function, const C& curves) {
    const int sign = sign_during(function, curves, 0, 0);
    return sign != 0 ? sign : sign_at(function, curves, Dyadic(0.0));
  }
  /// Returns the sign at a time in [0,1]: 1, 0 or -1. Exact.
  [[nodiscard]] static int sign_at(const F& function, const C& curves, const Dyadic& time) {
    return with_bead_function<C>(function,
                                 [&](const BeadFunction& f) { return exact_sign_at(f, curves, time); });
  }
};

}  // namespace kds
