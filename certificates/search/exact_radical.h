#pragma once
// The exact stage of radical certificates (radical.h), with the same answers as that of polynomial
// certificates (exact_search.h). The candidates for a failure are all distinct roots of the norm, even those
// at which the norm does not change sign. Each candidate is judged by the function's sign just after it. If
// the norm is the zero polynomial, the candidates are the roots of A and of B.

#include <optional>

#include "certificates/base/failure_time.h"
#include "certificates/base/radical.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"

namespace kds {

/// A + B sqrt(D), represented by the integer polynomials A, B and the norm.
struct ExactRadical {
  ExactPolynomial rational, root, norm;

  /// Returns the sign, computed by applying `sign_of` (sign_at or sign_after) to the polynomials.
  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
};

/// A radical certificate with integer coefficients.
struct ExactRadicalCertificate {
  ExactRadical radical;
  std::optional<ExactRadical> condition;
  bool side = true;

  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
  /// Returns whether a candidate at which the certificate is positive just after is a touch: zero there and
  /// positive on both sides.
  [[nodiscard]] bool touches(ExactTime& candidate) const;
  /// Returns a polynomial that has all roots of the certificate's function: the norm, or A B if the norm is
  /// zero.
  [[nodiscard]] ExactPolynomial candidates() const;
  [[nodiscard]] std::size_t largest_bit_length() const;
};

/// Runs the exact stage alone.
[[nodiscard]] Failure exact_first_failure(const ExactRadicalCertificate& certificate, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);

}  // namespace kds
