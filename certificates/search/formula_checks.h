#pragma once
// Checks of a certificate's formula before it is searched. At compile time, FormulaProbe reports mistakes in
// one sentence, where the formula's other views would report them deep within the templates of the searches.
// When a search is made, functions of too high a degree are rejected.

#include <algorithm>
#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/constants.h"
#include "motions/numbers/bernstein.h"
#include "motions/views/motion_view.h"

namespace kds {

namespace detail {

/// Returns the degree of a function of beads over curves of degree `of_curves`. `C`: Curves or LiftedCurves.
template <class Function, class C>
[[nodiscard]] constexpr int degree_of_function(int of_curves) {
  constexpr int degree = decltype(Function::formula(
      std::declval<const RecordingView<C::dimension, lifted<C>, channels_of<Function>>&>(),
      std::declval<Function>().beads))::degree;
  return degree < 0 ? -degree * of_curves : degree;
}

/// Returns the highest degree of a radical's three polynomials.
template <class Radical, class C>
[[nodiscard]] constexpr int degree_of_radical(int of_curves) {
  return std::max({degree_of_function<typename Radical::Rational, C>(of_curves),
                   degree_of_function<typename Radical::Root, C>(of_curves),
                   degree_of_function<typename Radical::Norm, C>(of_curves)});
}

template <class Function>
[[nodiscard]] constexpr std::string_view name_of_function() {
  if constexpr (NamedCertificate<Function>) {
    return Function::type.name;
  } else {
    return Function::name;  // a query about faces of a hull
  }
}

/// Throws std::invalid_argument if the function's degree is above `most_degree_of_function`, which 64-bit
/// binomials do not allow.
[[gnu::cold]] inline void require_searchable(std::string_view name, int degree_of_function,
                                             int degree_of_motion) {
  if (degree_of_function <= most_degree_of_function) return;
  throw std::invalid_argument(std::string(name) + " over motion of degree " +
                              std::to_string(degree_of_motion) + ": its function has degree " +
                              std::to_string(degree_of_function) + ", expected at most " +
                              std::to_string(most_degree_of_function));
}

}  // namespace detail

/// A quantity known only by its power of length. Zero has any power.
struct LengthPower {
  static constexpr int any = -1;

  int power = any;
  bool unlike = false;  ///< unlike powers were added to form it

  /// Returns a whole number, which has power 0.
  static constexpr LengthPower constant(double) { return {0}; }

  constexpr LengthPower& operator+=(const LengthPower& other) {
    unlike |= other.unlike || (power != any && other.power != any && power != other.power);
    power = std::max(power, other.power);
    return *this;
  }
  constexpr LengthPower& operator-=(const LengthPower& other) { return *this += other; }
  friend constexpr LengthPower operator+(LengthPower a, const LengthPower& b) { return a += b; }
  friend constexpr LengthPower operator-(LengthPower a, const LengthPower& b) { return a += b; }
  friend constexpr LengthPower operator-(const LengthPower& a) { return a; }
  friend constexpr LengthPower operator*(const LengthPower& a, const LengthPower& b) {
    return {a.power == any || b.power == any ? any : a.power + b.power, a.unlike || b.unlike};
  }
};

/// The view over which the compiler first checks a formula.
template <int DimensionValue, class Certificate>
class FormulaProbe {
  using Constants = ConstantsOf<Certificate>;
  static constexpr Channels channels = channels_of<Certificate>;
  template <class>
  static constexpr bool never = false;

 public:
  using Number = LengthPower;
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = 1;

  constexpr BernsteinVector<LengthPower, degree, dimension> difference(BeadId, BeadId) const {
    return lengths<dimension>();
  }
  constexpr auto weight(BeadId i) const { return weight_difference(i, i); }
  constexpr auto weight_difference(BeadId, BeadId) const {
    static_assert(channels.weights,
                  "the formula asks for weights: say so, `static constexpr bool uses_weights = true;`");
    return polynomial(2);
  }
  constexpr auto radius_difference(BeadId, BeadId) const {
    static_assert(channels.radii,
                  "the formula asks for radii: say so, `static constexpr bool uses_radii = true;`");
    return polynomial(1);
  }
  constexpr auto radius_sum(BeadId, BeadId) const {
    static_assert(channels.radii,
                  "the formula asks for radii: say so, `static constexpr bool uses_radii = true;`");
    return polynomial(1);
  }

  constexpr auto position(BeadId) const {
    static_assert(uses_positions<Certificate>,
                  "the formula asks for positions: say so, `static constexpr bool uses_positions = true;`");
    return lengths<dimension>();
  }
  template <int Power>
  constexpr auto constant(Constant<Power> Constants::*) const {
    return polynomial(Power);
  }
  template <int Dimension>
  constexpr auto constant(ConstantVector<Dimension> Constants::*) const {
    static_assert(Dimension == dimension, "a ConstantVector of other dimension than the motion's");
    return lengths<Dimension>();
  }
  template <class Other>
  constexpr auto constant(const Other&) const {
    static_assert(never<Other>,
                  "the formula asks for a constant that is none: `view.constant(&Constants::name)` takes a "
                  "kds::Constant or a kds::ConstantVector of the certificate's `struct Constants`");
    return polynomial(1);
  }
  template <int Dimension>
  constexpr BeadId bead(ConstantPoint<Dimension> Constants::*) const {
    static_assert(Dimension == dimension, "a ConstantPoint of other dimension than the motion's");
    return 0;
  }
  constexpr BeadId bead(ConstantBead Constants::*) const { return 0; }
  template <class Other>
  constexpr BeadId bead(const Other&) const {
    static_assert(never<Other>,
                  "the formula asks for the bead of what is none: `view.bead(&Constants::name)` takes a "
                  "kds::ConstantPoint or a kds::ConstantBead of the certificate's `struct Constants`");
    return 0;
  }

 private:
  static constexpr Bernstein<LengthPower, degree> polynomial(int power) { return {{{{power}, {power}}}}; }
  template <int Dimension>
  static constexpr BernsteinVector<LengthPower, degree, Dimension> lengths() {
    BernsteinVector<LengthPower, degree, Dimension> vector;
    vector.fill(polynomial(1));
    return vector;
  }
};

template <class Certificate, int Dimension>
concept HasStaticFormula = requires(const FormulaProbe<Dimension, Certificate>& view,
                                    const Certificate& certificate) {
  Certificate::formula(view, certificate.beads);
};

namespace detail {

template <class Certificate, int Dimension>
[[nodiscard]] constexpr bool adds_unlike_powers() {
  const auto value =
      Certificate::formula(FormulaProbe<Dimension, Certificate>{}, decltype(Certificate{}.beads){});
  return std::any_of(value.scaled.begin(), value.scaled.end(),
                     [](const LengthPower& coefficient) { return coefficient.unlike; });
}

}  // namespace detail

/// Checks the formula at compile time, if it is constexpr. Otherwise the mistake is reported when the
/// formula's error bound is derived.
template <class Certificate, int Dimension>
concept AddsUnlikePowers = requires {
  requires std::bool_constant < detail::adds_unlike_powers<Certificate, Dimension>()
  > ::value;
};

/// Rejects terms of unlike degrees with a readable message.
template <int A, int B>
requires(A != B) constexpr auto operator+(const Bernstein<LengthPower, A>& a,
                                          const Bernstein<LengthPower, B>&) {
  static_assert(A == B,
                "the formula adds terms of unlike degrees: their powers of length are unlike, or one is a "
                "square to be elevated, `elevate<2 * View::degree>(...)`");
  return a;
}
template <int A, int B>
requires(A != B) constexpr auto operator-(const Bernstein<LengthPower, A>& a,
                                          const Bernstein<LengthPower, B>&) {
  static_assert(A == B,
                "the formula subtracts terms of unlike degrees: their powers of length are unlike, or one is "
                "a square to be elevated, `elevate<2 * View::degree>(...)`");
  return a;
}

/// Rejects adding a bare number to a polynomial of lengths, with a readable message.
template <int Degree, class Bare>
requires(std::is_arithmetic_v<Bare>) constexpr auto operator+(const Bernstein<LengthPower, Degree>& lengths,
                                                              Bare) {
  static_assert(!std::is_arithmetic_v<Bare>,
                "the formula adds a bare constant: a number has no power of length; declare it in `struct "
                "Constants`, as a kds::Constant<1> if it is a length");
  return lengths;
}
template <int Degree, class Bare>
requires(std::is_arithmetic_v<Bare>) constexpr auto operator-(const Bernstein<LengthPower, Degree>& lengths,
                                                              Bare) {
  static_assert(!std::is_arithmetic_v<Bare>,
                "the formula subtracts a bare constant: a number has no power of length; declare it in "
                "`struct Constants`, as a kds::Constant<1> if it is a length");
  return lengths;
}
template <int Degree, class Bare>
requires(std::is_arithmetic_v<Bare>) constexpr auto operator+(Bare,
                                                              const Bernstein<LengthPower, Degree>& lengths) {
  static_assert(!std::is_arithmetic_v<Bare>,
                "the formula adds to a bare constant: a number has no power of length; declare it in `struct "
                "Constants`, as a kds::Constant<1> if it is a length");
  return lengths;
}
template <int Degree, class Bare>
requires(std::is_arithmetic_v<Bare>) constexpr auto operator-(Bare,
                                                              const Bernstein<LengthPower, Degree>& lengths) {
  static_assert(!std::is_arithmetic_v<Bare>,
                "the formula subtracts from a bare constant: a number has no power of length; declare it in "
                "`struct Constants`, as a kds::Constant<1> if it is a length");
  return lengths;
}
template <int Degree, class Bare>
requires(std::is_arithmetic_v<Bare>) constexpr auto operator*(Bare,
                                                              const Bernstein<LengthPower, Degree>& lengths) {
  static_assert(!std::is_arithmetic_v<Bare>,
                "the formula multiplies by a bare constant: a ratio is said by two lengths, each a "
                "kds::Constant<1> in `struct Constants`, one on either side");
  return lengths;
}
template <int Degree, class Bare>
requires(std::is_arithmetic_v<Bare>) constexpr auto operator*(const Bernstein<LengthPower, Degree>& lengths,
                                                              Bare number) {
  return number * lengths;
}

}  // namespace kds
