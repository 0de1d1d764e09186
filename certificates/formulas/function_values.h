#pragma once
// Evaluates a function of beads in every number type, one function at a time, over the curves of any motion.
// Its formula is recorded once and played, so nothing is compiled for it. The first filters (lanes of
// doubles, signs of radicals) do compile formulas: certificates/filters, certificates/search.

#include "certificates/formulas/bead_function.h"
#include "certificates/formulas/formula_in_double.h"
#include "certificates/formulas/formula_in_integers.h"
#include "motions/numbers/exact_number.h"

namespace kds {

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
