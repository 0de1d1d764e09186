#pragma once
// The double stage: a polynomial whose Bernstein coefficients are known up to a proved error, and the search
// for the first place where it certainly turns negative. The work is bounded; if a result cannot be proved,
// the class says so.

#include <cstdint>

#include "motions/numbers/coefficients.h"

namespace kds {

enum class Verdict : std::uint8_t { never, found, undecided };

struct BoundedPolynomial {
  Coefficients<double> bernstein;  ///< plain Bernstein coefficients on [0,1], at least one
  double value_error = 0;          ///< error of any value at a double
  double local_error = 0;          ///< error of coefficients after subdivision; NaN: nothing can be proved

  struct Bracket {
    double lower, upper;
  };
  struct Result {
    Verdict verdict;
    Bracket bracket;
  };

  [[nodiscard]] int degree() const { return static_cast<int>(bernstein.size()) - 1; }
  [[nodiscard]] double value_at(double u) const;
  /// Returns 1 or -1 if that is certainly the sign at u, else 0.
  [[nodiscard]] int certain_sign_at(double u) const;
  /// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const;

  /// Returns the first root after `from` at which the polynomial turns negative, in a bracket that proves it:
  /// the polynomial is certainly positive on [from, lower] and negative at upper, with one root between. At
  /// `from` it must be certainly positive, either by its value or because it is `known` to be.
  [[nodiscard]] Result first_descent(double from, bool known = false) const;

  /// Returns a point near the root of the only descent between `lower` and `upper`, computed from the
  /// coefficients without error bounds. Proves nothing.
  [[nodiscard]] double root_between(double lower, double upper) const;
};

[[nodiscard]] BoundedPolynomial operator-(BoundedPolynomial p);

}  // namespace kds
