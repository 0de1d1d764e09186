#pragma once
// Polynomials with integer coefficients on u in [0,1], in scaled Bernstein form
// (motions/numbers/bernstein.h), of any degree. All results are exact. Substituting t = u/(1-u) makes
// the same coefficients an ordinary polynomial in t >= 0. The gcd and the square-free part are computed in
// that form, and Descartes' rule of signs on the coefficients bounds the number of roots in (0,1).
//
// Whether a polynomial is wide (wide_polynomial.h) is decided when it is constructed. The coefficients of a
// wide polynomial are computed only as precisely as an answer needs, and its roots are isolated scale by
// scale. Nearly all polynomials are not wide; for them integers and bisection are faster.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// An interval that contains exactly one root, with no root at its ends. If lower == upper, it is the root
/// itself.
struct RootInterval {
  Dyadic lower, upper;
  unsigned digits = 1;    ///< how many binary digits the next narrowing step should gain (narrow_root)
  int sign_at_lower = 0;  ///< the polynomial's sign at `lower`; 0 if unknown
};

/// Takes one root; returns whether the next one is wanted.
using RootVisitor = std::function<bool(RootInterval)>;

class WidePolynomial;

class ExactPolynomial {
 public:
  ExactPolynomial() = default;
  explicit ExactPolynomial(std::vector<Integer> scaled) : scaled_(std::move(scaled)) {}
  template <int Degree>
  explicit ExactPolynomial(const Bernstein<Integer, Degree>& p) : scaled_(p.scaled.begin(), p.scaled.end()) {}
  /// Constructs a wide polynomial. Copies share all that is found out about it.
  explicit ExactPolynomial(std::shared_ptr<const WidePolynomial> wide) : wide_(std::move(wide)) {}

  /// Returns null if the polynomial is not wide.
  [[nodiscard]] const WidePolynomial* wide() const { return wide_.get(); }
  [[nodiscard]] const std::vector<Integer>& scaled() const { return wide_ ? wide_whole() : scaled_; }
  [[nodiscard]] bool is_zero() const;
  /// Returns the bit length of the longest coefficient. For a wide polynomial the result may be one too
  /// large.
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// Returns the sign on (u, u+delta); 0 only for the zero polynomial.
  [[nodiscard]] int sign_after(const Dyadic& u) const;

  /// Returns the number of sign changes among the non-zero coefficients. By Descartes' rule of signs it is at
  /// least the number of roots in (0,1), counted with multiplicity, and has the same parity; 0 and 1 are
  /// exactly the number of roots.
  [[nodiscard]] int sign_variations() const;
  /// Returns the sign on (lower, upper) if Descartes' rule proves that there is no root between them, else 0.
  /// For a wide polynomial the proof uses only as many digits as the interval has, unless `exactly` is set.
  [[nodiscard]] int sign_between(const Dyadic& lower, const Dyadic& upper, bool exactly = false) const;
  /// Returns whether Descartes' rule proves that there is at most one root between the ends.
  [[nodiscard]] bool has_few_roots_between(const Dyadic& lower, const Dyadic& upper) const;

  /// Returns the polynomial restricted to [lower, upper], times a positive number.
  [[nodiscard]] ExactPolynomial restricted(const Dyadic& lower, const Dyadic& upper) const;

  /// Returns a polynomial with the same roots in [0,1), each once. Roots at u = 1 are dropped.
  [[nodiscard]] ExactPolynomial square_free() const;
  /// Returns the greatest common divisor with respect to roots in [0,1), up to a constant factor.
  [[nodiscard]] static ExactPolynomial gcd(const ExactPolynomial& a, const ExactPolynomial& b);
  /// Returns whether the polynomial is a constant or zero, and thus has no isolated roots in [0,1).
  [[nodiscard]] bool is_constant() const;

 private:
  [[nodiscard]] const std::vector<Integer>& wide_whole() const;
  /// Returns a polynomial with these coefficients, wide if this one is.
  [[nodiscard]] ExactPolynomial alike(std::vector<Integer> scaled) const;

  std::vector<Integer> scaled_;  // empty if the polynomial is wide
  std::shared_ptr<const WidePolynomial> wide_;
};

/// Visits the roots of a square-free polynomial in [lower, upper], ascending. The isolating intervals are
/// disjoint except for common ends.
void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit);

/// Returns all roots that visit_roots visits.
[[nodiscard]] std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                                      const Dyadic& upper);

}  // namespace kds
