#pragma once
// The stages of the failure-time cascade after its first filter, for one certificate: in double with error
// bounds, however these were computed, and in integers.

#include <optional>

#include "certificates/base/kernel.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// Returns the failure of a certificate that does not hold just after now: its sign is certainly negative on
/// all of the present bracket.
[[nodiscard]] inline Failure failed_at_birth(const Instant& now) {
  return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
}

/// Returns the failure with the stage that decided it.
[[nodiscard]] inline Failure decided(Failure failure, DecidedBy stage) {
  failure.time.decided_by = stage;
  return failure;
}

/// Returns the failure that doubles prove for a certificate with this function, or nothing. The caller names
/// the stage.
[[nodiscard]] std::optional<Failure> proved_failure(const BoundedFunction& bounded, const Instant& now,
                                                    KnownAtStart known);

/// Returns the exact failure, a root of `function`, as a bracket in doubles.
[[nodiscard]] Failure to_failure(const ExactPolynomial& function, ExactFailure& root);

/// Returns the first failure of a polynomial with integer coefficients.
[[nodiscard]] Failure exact_first_failure(const ExactPolynomial& function, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);
/// Like exact_first_failure, but tries doubles first.
[[nodiscard]] Failure rounded_first_failure(const ExactPolynomial& function, const Instant& now,
                                            KnownAtStart known, StageCounts& stages, TouchPolicy touches);

/// Returns the sign that `exact_sign` computes, at `now` or just after it. Tries doubles first.
[[nodiscard]] int rounded_sign(const ExactPolynomial& function, const Instant& now,
                               int (*exact_sign)(const ExactPolynomial&, ExactTime&));

}  // namespace kds
