#pragma once
// The double stage: a polynomial whose Bernstein coefficients are known up to a proved error, and the first
// place where it certainly turns negative. No allocation, bounded work. What it cannot prove it says so.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "certificates/search/isolate_lanes.h"

namespace kds {

enum class Verdict : std::uint8_t { never, found, undecided };

template <int Degree>
struct BoundedPolynomial {
  using Coefficients = std::array<double, static_cast<std::size_t>(Degree) + 1>;

  Coefficients bernstein;  ///< plain Bernstein coefficients on [0,1]
  double value_error;      ///< of any value at a double
  double local_error;      ///< of the coefficients after subdivision; NaN: nothing can be proved

  struct Bracket {
    double lower, upper;
  };
  struct Result {
    Verdict verdict;
    Bracket bracket;
  };

  [[nodiscard]] double value_at(double u) const {
    Coefficients c = bernstein;
    const double v = 1 - u;
    for (std::size_t round = Degree; round > 0; --round) {
      for (std::size_t i = 0; i < round; ++i) c[i] = v * c[i] + u * c[i + 1];
    }
    return c[0];
  }

  /// 1 or -1 if that is the sign at u for certain, else 0.
  [[nodiscard]] int certain_sign_at(double u) const {
    const double value = value_at(u);
    return value > value_error ? 1 : value < -value_error ? -1 : 0;
  }

  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const {
    const double value = value_at(upper);
    double reach = value_error;
    if (lower < upper) {
      double steepest = 0;
      for (std::size_t i = 0; i < Degree; ++i)
        steepest = std::max(steepest, std::abs(bernstein[i + 1] - bernstein[i]));
      // |p'| <= Degree * steepest; coefficients err by value_error each.
      reach += Degree * (steepest + 2 * value_error) * (upper - lower) * (1 + 0x1p-40);
    }
    return value > reach ? 1 : value < -reach ? -1 : 0;
  }

  /// The first root after `from` at which the polynomial turns negative, in a bracket that proves it:
  /// certainly positive on [from, lower], negative at upper, and one root between. `from` must be certainly
  /// positive, by its value or `known` to be.
  [[nodiscard]] Result first_descent(double from, bool known = false) const;

  /// Near the root of its only descent between these, as far as the coefficients themselves tell: no proof.
  [[nodiscard]] double root_between(double lower, double upper) const;
};

template <int Degree>
auto BoundedPolynomial<Degree>::first_descent(double from, bool known) const -> Result {
  LanesDescent<Degree> descent;
  for (std::size_t k = 0; k <= Degree; ++k) descent.bernstein[k] = Lanes(bernstein[k]);
  descent.value_error = Lanes(value_error);
  descent.local_error = Lanes(local_error);
  descent.part = descent.bernstein;
  if (from > 0) casteljau(descent.part, Lanes(from));
  LanesSearch search;
  constexpr Lanes::Mask first{-1, 0, 0, 0};
  isolate_lanes(descent, from, first, known ? first : Lanes::Mask{}, search);
  if (search.never[0] != 0) return {Verdict::never, {}};
  if (search.found[0] == 0) return {Verdict::undecided, {}};
  narrow_lanes(descent, first);
  return {Verdict::found, {descent.lower.v[0], descent.upper.v[0]}};
}

template <int Degree>
double BoundedPolynomial<Degree>::root_between(double lower, double upper) const {
  LanesCoefficients<Degree> part;
  for (std::size_t k = 0; k <= Degree; ++k) part[k] = Lanes(bernstein[k]);
  casteljau_left(part, Lanes(upper));
  casteljau(part, Lanes(lower / upper));
  Lanes slope;
  return lower + (upper - lower) * detail::halley(part, Lanes::Mask{-1, 0, 0, 0}, slope).v[0];
}

}  // namespace kds
