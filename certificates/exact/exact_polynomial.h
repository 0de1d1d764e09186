#pragma once
// Polynomials with whole coefficients on u in [0,1], scaled Bernstein form (motions/numbers/bernstein.h), any
// degree. Everything here is exact. Setting t = u/(1-u) makes the same coefficients an ordinary polynomial in
// t >= 0, which is how gcd and square-free part are computed; Descartes' rule of signs on them bounds the
// roots in (0,1).

#include <functional>
#include <utility>
#include <vector>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/exact_number.h"

namespace kds {

class ExactPolynomial {
 public:
  ExactPolynomial() = default;
  explicit ExactPolynomial(std::vector<Integer> scaled) : scaled_(std::move(scaled)) {}
  template <int Degree>
  explicit ExactPolynomial(const Bernstein<Integer, Degree>& p) : scaled_(p.scaled.begin(), p.scaled.end()) {}

  [[nodiscard]] const std::vector<Integer>& scaled() const { return scaled_; }
  [[nodiscard]] bool is_zero() const;
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// Sign on (u, u+delta); 0 only for the zero polynomial.
  [[nodiscard]] int sign_after(const Dyadic& u) const;

  /// Sign changes among the non-zero coefficients: at least the number of roots in (0,1), with multiplicity,
  /// and of the same parity; 0 and 1 are the number itself.
  [[nodiscard]] int sign_variations() const;

  /// The polynomial as seen on [lower, upper], times a positive number.
  [[nodiscard]] ExactPolynomial restricted(const Dyadic& lower, const Dyadic& upper) const;

  /// A polynomial with the same roots in [0,1), each once; roots at u = 1 are dropped.
  [[nodiscard]] ExactPolynomial square_free() const;
  /// Greatest common divisor as regards roots in [0,1), up to a constant factor.
  [[nodiscard]] static ExactPolynomial gcd(const ExactPolynomial& a, const ExactPolynomial& b);
  /// Whether there are no roots in [0,1) to speak of: a constant, or zero.
  [[nodiscard]] bool is_constant() const;

 private:
  std::vector<Integer> scaled_;
};

/// An interval with one root and no root at its ends; or, where lower == upper, the root itself.
struct RootInterval {
  Dyadic lower, upper;
};

/// Takes one root; returns whether the next one is wanted.
using RootVisitor = std::function<bool(RootInterval)>;

/// Visits the roots of a square-free polynomial in [lower, upper], ascending; their intervals are disjoint
/// but for touching ends.
void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit);

/// All the roots that visit_roots visits.
[[nodiscard]] std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                                      const Dyadic& upper);

}  // namespace kds
