#pragma once
// A function of beads in every kind of number, one function at a time, over the curves of any motion. Its
// formula is written down once and played: nothing is compiled for it. (The filters that come first, lanes of
// doubles and signs of radicals, do compile formulas: certificates/filters, certificates/search.)

#include "certificates/formulas/bead_function.h"
#include "certificates/formulas/formula_in_double.h"
#include "certificates/formulas/formula_in_integers.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// `C`: Curves or LiftedCurves.
template <class F, class C>
struct FunctionValues {
  static_assert(C::dimension >= 1 && C::dimension <= 3, "motions are of 1 to 3 dimensions");

  /// Of the formula in double under a motion of this degree. Kept: asked for again, it is at hand.
  [[nodiscard]] static const ErrorBound& error_bound(int degree) {
    return detail::known_formula<F, C>().error_bound(degree);
  }

  /// By the function's own filter.
  [[nodiscard]] static BoundedFunction bounded(const F& function, const C& curves) {
    return with_bead_function<C>(function,
                                 [&](const BeadFunction& f) { return bounded_function(f, curves); });
  }
  /// With errors followed operation by operation.
  [[nodiscard]] static BoundedFunction tracked(const F& function, const C& curves) {
    return with_bead_function<C>(function,
                                 [&](const BeadFunction& f) { return tracked_function(f, curves); });
  }
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, without the polynomial; else 0.
  [[nodiscard]] static int sign_during(const F& function, const C& curves, double lower, double upper) {
    return with_bead_function<C>(
        function, [&](const BeadFunction& f) { return certain_sign_during(f, curves, lower, upper); });
  }

  /// On whole numbers, times a positive one. Exact.
  [[nodiscard]] static ExactPolynomial exact(const F& function, const C& curves) {
    return with_bead_function<C>(function, [&](const BeadFunction& f) { return exact_function(f, curves); });
  }
  /// 1, 0 or -1 of curves of degree 0. Exact, in double where that will do.
  [[nodiscard]] static int sign_at_rest(const F& function, const C& curves) {
    const int sign = sign_during(function, curves, 0, 0);
    return sign != 0 ? sign : sign_at(function, curves, Dyadic(0.0));
  }
  /// 1, 0 or -1 at a time of [0,1]. Exact.
  [[nodiscard]] static int sign_at(const F& function, const C& curves, const Dyadic& time) {
    return with_bead_function<C>(function,
                                 [&](const BeadFunction& f) { return exact_sign_at(f, curves, time); });
  }
};

}  // namespace kds
