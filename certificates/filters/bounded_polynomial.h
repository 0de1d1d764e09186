#pragma once
// The double stage: a polynomial whose Bernstein coefficients are known up to a proved error, and the first
// place where it certainly turns negative. Bounded work; what it cannot prove it says so.

#include <cstdint>

#include "motions/numbers/coefficients.h"

namespace kds {

enum class Verdict : std::uint8_t { never, found, undecided };

struct BoundedPolynomial {
  Coefficients<double> bernstein;  ///< plain Bernstein coefficients on [0,1], one at least
  double value_error = 0;          ///< of any value at a double
  double local_error = 0;          ///< of the coefficients after subdivision; NaN: nothing can be proved

  struct Bracket {
    double lower, upper;
  };
  struct Result {
    Verdict verdict;
    Bracket bracket;
  };

  [[nodiscard]] int degree() const { return static_cast<int>(bernstein.size()) - 1; }
  [[nodiscard]] double value_at(double u) const;
  /// 1 or -1 if that is the sign at u for certain, else 0.
  [[nodiscard]] int certain_sign_at(double u) const;
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const;

  /// The first root after `from` at which the polynomial turns negative, in a bracket that proves it:
  /// certainly positive on [from, lower], negative at upper, and one root between. `from` must be certainly
  /// positive, by its value or `known` to be.
  [[nodiscard]] Result first_descent(double from, bool known = false) const;

  /// Near the root of its only descent between these, as far as the coefficients themselves tell: no proof.
  [[nodiscard]] double root_between(double lower, double upper) const;
};

[[nodiscard]] BoundedPolynomial operator-(BoundedPolynomial p);

}  // namespace kds
