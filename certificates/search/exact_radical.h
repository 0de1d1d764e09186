#pragma once
// The exact stage of radical certificates (radical.h): the same answers as of polynomial ones
// (exact_search.h). Candidates for a failure are all distinct roots of the norm, also where it does not
// change sign; each is judged by the sign of the function just after it. Where the norm is the zero
// polynomial, they are those of A and of B.

#include <optional>

#include "certificates/base/failure_time.h"
#include "certificates/base/radical.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"

namespace kds {

/// A + B sqrt(D) by its three polynomials, on integers.
struct ExactRadical {
  ExactPolynomial rational, root, norm;

  /// By `sign_of` (sign_at or sign_after) of the polynomials.
  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
};

/// A radical certificate on integers.
struct ExactRadicalCertificate {
  ExactRadical radical;
  std::optional<ExactRadical> condition;
  bool side = true;

  [[nodiscard]] int sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const;
  /// Zero at a candidate and positive on both sides, where it is positive just after.
  [[nodiscard]] bool touches(ExactTime& candidate) const;
  /// Has all roots of the certificate's function: the norm, or, where that is zero, A B.
  [[nodiscard]] ExactPolynomial candidates() const;
  [[nodiscard]] std::size_t largest_bit_length() const;
};

/// The exact stage alone.
[[nodiscard]] Failure exact_first_failure(const ExactRadicalCertificate& certificate, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);

}  // namespace kds
