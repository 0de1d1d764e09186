#pragma once
// Polynomials with whole coefficients on u in [0,1], scaled Bernstein form (motions/numbers/bernstein.h), any
// degree. Every answer here is exact. Setting t = u/(1-u) makes the same coefficients an ordinary polynomial
// in t >= 0, which is how gcd and square-free part are computed; Descartes' rule of signs on them bounds the
// roots in (0,1).
//
// Coefficients may be very long, and an answer seldom needs them: it is looked for in their leading digits
// first (motions/numbers/enclosure.h), whether there are common factors modulo a prime, and only where these
// do not tell are the whole numbers formed. Copies share what has been found out, for one thread.

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/enclosure.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/modular.h"

namespace kds {

/// Says what a polynomial's coefficients are, as precisely as it is asked.
class CoefficientSource {
 public:
  virtual ~CoefficientSource() = default;
  [[nodiscard]] virtual std::vector<Enclosure> leading_digits() const = 0;
  /// Modulo 2^61 - fold.
  [[nodiscard]] virtual std::vector<Residue> residues(std::uint64_t fold) const = 0;
  [[nodiscard]] virtual std::vector<Integer> whole() const = 0;
};

/// How often a polynomial's coefficients change sign, as far as their leading digits tell.
struct Variations {
  int least = 0, most = 0;
  int sign = 0;  ///< of all that are not 0, where none change: known if most is 0
};

/// An interval with one root and no root at its ends; or, where lower == upper, the root itself.
struct RootInterval {
  Dyadic lower, upper;
};

class ExactPolynomial {
 public:
  ExactPolynomial();
  explicit ExactPolynomial(std::vector<Integer> scaled);
  explicit ExactPolynomial(std::unique_ptr<const CoefficientSource> source);
  template <int Degree>
  explicit ExactPolynomial(const Bernstein<Integer, Degree>& p)
      : ExactPolynomial(std::vector<Integer>(p.scaled.begin(), p.scaled.end())) {}

  [[nodiscard]] const std::vector<Integer>& scaled() const;
  [[nodiscard]] const std::vector<Enclosure>& leading_digits() const;
  /// Modulo the first of the primes.
  [[nodiscard]] std::vector<Residue> residues() const;
  [[nodiscard]] bool is_zero() const;
  /// Of the longest coefficient: by its leading digits, one more than it is at the most.
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// Sign on (u, u+delta); 0 only for the zero polynomial.
  [[nodiscard]] int sign_after(const Dyadic& u) const;

  /// Sign changes among the non-zero coefficients: at least the number of roots in (0,1), with multiplicity,
  /// and of the same parity; 0 and 1 are the number itself.
  [[nodiscard]] int sign_variations() const;
  /// Of the polynomial as seen on [lower, upper], whose signs at both ends may be given, by leading digits.
  [[nodiscard]] Variations variations_on(const Dyadic& lower, const Dyadic& upper) const;
  [[nodiscard]] Variations variations_on(const Dyadic& lower, const Dyadic& upper, int sign_at_lower,
                                         int sign_at_upper) const;

  /// The polynomial as seen on [lower, upper], times a positive number.
  [[nodiscard]] ExactPolynomial restricted(const Dyadic& lower, const Dyadic& upper) const;

  /// A polynomial with the same roots in [0,1), each once; roots at u = 1 are dropped. Found once.
  [[nodiscard]] ExactPolynomial square_free() const;
  /// Greatest common divisor as regards roots in [0,1), up to a constant factor.
  [[nodiscard]] static ExactPolynomial gcd(const ExactPolynomial& a, const ExactPolynomial& b);
  /// Whether there are no roots in [0,1) to speak of: a constant, or zero.
  [[nodiscard]] bool is_constant() const;

  /// For isolate_roots.h: the roots in [0,1] as far as they are isolated, once they are.
  [[nodiscard]] std::optional<std::vector<RootInterval>>& isolated() const;

 private:
  struct State;
  explicit ExactPolynomial(std::shared_ptr<State> state) : state_(std::move(state)) {}

  std::shared_ptr<State> state_;
};

}  // namespace kds
