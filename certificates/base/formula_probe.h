#pragma once
// The view over which a certificate's formula is looked at first, by the compiler alone, so that what is
// wrong with it is said in a sentence and at once: the formula's other views come to light deep within
// searches.

#include <type_traits>

#include "certificates/base/certificate.h"

namespace kds {

template <int DimensionValue, Channels channels>
class FormulaProbe {
 public:
  using Number = Magnitude;
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = 1;

  // Never called: a formula's type is all that is asked for.
  BernsteinVector<Magnitude, degree, dimension> difference(BeadId, BeadId) const;
  auto weight_difference(BeadId, BeadId) const {
    static_assert(channels.weights,
                  "the formula asks for weights: say so, `static constexpr bool uses_weights = true;`");
    return Bernstein<Magnitude, degree>();
  }
  auto radius_difference(BeadId, BeadId) const {
    static_assert(channels.radii,
                  "the formula asks for radii: say so, `static constexpr bool uses_radii = true;`");
    return Bernstein<Magnitude, degree>();
  }
  auto radius_sum(BeadId, BeadId) const {
    static_assert(channels.radii,
                  "the formula asks for radii: say so, `static constexpr bool uses_radii = true;`");
    return Bernstein<Magnitude, degree>();
  }
};

static_assert(MotionView<FormulaProbe<3, Channels{}>>);

template <class Certificate, int Dimension>
concept HasStaticFormula = requires(const FormulaProbe<Dimension, channels_of<Certificate>>& view,
                                    const Certificate& certificate) {
  Certificate::formula(view, certificate.beads);
};

/// A bare number added to a polynomial of lengths: refused in a sentence.
template <int Degree, class Constant>
requires(std::is_arithmetic_v<Constant>) auto operator+(const Bernstein<Magnitude, Degree>& lengths,
                                                        Constant) {
  static_assert(
      !std::is_arithmetic_v<Constant>,
      "the formula adds a bare constant: terms need the same power of length, and a number has none");
  return lengths;
}
template <int Degree, class Constant>
requires(std::is_arithmetic_v<Constant>) auto operator-(const Bernstein<Magnitude, Degree>& lengths,
                                                        Constant) {
  static_assert(
      !std::is_arithmetic_v<Constant>,
      "the formula subtracts a bare constant: terms need the same power of length, and a number has none");
  return lengths;
}
template <int Degree, class Constant>
requires(std::is_arithmetic_v<Constant>) auto operator+(Constant,
                                                        const Bernstein<Magnitude, Degree>& lengths) {
  static_assert(
      !std::is_arithmetic_v<Constant>,
      "the formula adds to a bare constant: terms need the same power of length, and a number has none");
  return lengths;
}
template <int Degree, class Constant>
requires(std::is_arithmetic_v<Constant>) auto operator-(Constant,
                                                        const Bernstein<Magnitude, Degree>& lengths) {
  static_assert(!std::is_arithmetic_v<Constant>,
                "the formula subtracts from a bare constant: terms need the same power of length, and a "
                "number has none");
  return lengths;
}

}  // namespace kds
