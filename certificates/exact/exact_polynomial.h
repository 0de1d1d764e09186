#pragma once
// Polynomials with whole coefficients on u in [0,1], scaled Bernstein form (motions/numbers/bernstein.h), any
// degree. Everything here is exact. Setting t = u/(1-u) makes the same coefficients an ordinary polynomial in
// t >= 0, which is how gcd and square-free part are computed; Descartes' rule of signs on them bounds the
// roots in (0,1).
//
// Whether a polynomial is wide (wide_polynomial.h) is known when it is made. If it is, its coefficients are
// formed as precisely as an answer takes, and roots are looked for scale by scale; if it is not, as nearly
// all are, whole numbers and halving are faster.

#include <memory>
#include <utility>
#include <vector>

#include "certificates/exact/root_interval.h"
#include "motions/numbers/bernstein.h"
#include "motions/numbers/exact_number.h"

namespace kds {

class WidePolynomial;

class ExactPolynomial {
 public:
  ExactPolynomial() = default;
  explicit ExactPolynomial(std::vector<Integer> scaled) : scaled_(std::move(scaled)) {}
  template <int Degree>
  explicit ExactPolynomial(const Bernstein<Integer, Degree>& p) : scaled_(p.scaled.begin(), p.scaled.end()) {}
  /// Copies share what is found out about a wide one.
  explicit ExactPolynomial(std::shared_ptr<const WidePolynomial> wide) : wide_(std::move(wide)) {}

  /// Null where it is not wide.
  [[nodiscard]] const WidePolynomial* wide() const { return wide_.get(); }
  [[nodiscard]] const std::vector<Integer>& scaled() const { return wide_ ? wide_whole() : scaled_; }
  [[nodiscard]] bool is_zero() const;
  /// Of the longest coefficient; if it is wide, perhaps one more.
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// Sign on (u, u+delta); 0 only for the zero polynomial.
  [[nodiscard]] int sign_after(const Dyadic& u) const;

  /// Sign changes among the non-zero coefficients: at least the number of roots in (0,1), with multiplicity,
  /// and of the same parity; 0 and 1 are the number itself.
  [[nodiscard]] int sign_variations() const;
  /// The sign on (lower, upper) where Descartes' rule tells that there is no root between, else 0. If it is
  /// wide, as far as digits tell that are as many as the interval has; or `exactly`.
  [[nodiscard]] int sign_between(const Dyadic& lower, const Dyadic& upper, bool exactly = false) const;
  /// Descartes' rule tells that there is one root between at most.
  [[nodiscard]] bool has_few_roots_between(const Dyadic& lower, const Dyadic& upper) const;

  /// The polynomial as seen on [lower, upper], times a positive number.
  [[nodiscard]] ExactPolynomial restricted(const Dyadic& lower, const Dyadic& upper) const;

  /// A polynomial with the same roots in [0,1), each once; roots at u = 1 are dropped.
  [[nodiscard]] ExactPolynomial square_free() const;
  /// Greatest common divisor as regards roots in [0,1), up to a constant factor.
  [[nodiscard]] static ExactPolynomial gcd(const ExactPolynomial& a, const ExactPolynomial& b);
  /// Whether there are no roots in [0,1) to speak of: a constant, or zero.
  [[nodiscard]] bool is_constant() const;

 private:
  [[nodiscard]] const std::vector<Integer>& wide_whole() const;
  /// Of these coefficients, and wide if this one is.
  [[nodiscard]] ExactPolynomial alike(std::vector<Integer> scaled) const;

  std::vector<Integer> scaled_;  // none if it is wide
  std::shared_ptr<const WidePolynomial> wide_;
};

/// Visits the roots of a square-free polynomial in [lower, upper], ascending; their intervals are disjoint
/// but for touching ends.
void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit);

/// All the roots that visit_roots visits.
[[nodiscard]] std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                                      const Dyadic& upper);

}  // namespace kds
