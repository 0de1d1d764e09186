#pragma once
// A function of beads in every kind of number but lanes, over the curves of any motion: what does not depend
// on a motion's degree is compiled once for the function. The definitions are in define_function_values.h,
// for the one file that instantiates them.

#include "certificates/base/certificate.h"
#include "certificates/filters/bounded_polynomial.h"
#include "certificates/filters/error_bound.h"
#include "motions/curves/curves.h"

namespace kds {

class Dyadic;
class ExactPolynomial;

/// A function in double with its errors, and whether all its coefficients are certainly positive.
struct BoundedFunction {
  BoundedPolynomial polynomial;
  bool positive = false;
};

/// `C`: Curves or LiftedCurves.
template <class F, class C>
struct FunctionValues {
  /// Of the formula in double under a motion of this degree. Kept: asked for again, it is at hand.
  [[nodiscard]] static const ErrorBound& error_bound(int degree);

  /// By the function's own filter.
  [[nodiscard]] static BoundedFunction bounded(const F& function, const C& curves);
  /// With errors followed operation by operation.
  [[nodiscard]] static BoundedFunction tracked(const F& function, const C& curves);
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, without the polynomial; else 0.
  [[nodiscard]] static int sign_during(const F& function, const C& curves, double lower, double upper);

  /// On whole numbers, times a positive one. Exact.
  [[nodiscard]] static ExactPolynomial exact(const F& function, const C& curves);
  /// 1, 0 or -1 of curves of degree 0. Exact, in double where that will do.
  [[nodiscard]] static int sign_at_rest(const F& function, const C& curves);
  /// 1, 0 or -1 at a time of [0,1]. Exact.
  [[nodiscard]] static int sign_at(const F& function, const C& curves, const Dyadic& time);
};

}  // namespace kds
