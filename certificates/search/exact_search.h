#pragma once
// The exact stage of the failure-time cascade: the first failure of a polynomial with integer coefficients.
// Roots are found in double if that is precise enough, else with integers.

#include "certificates/base/failure_time.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// Returns the exact failure, a root of `function`, as a bracket in doubles.
[[nodiscard]] Failure to_failure(const ExactPolynomial& function, ExactFailure& root);

[[nodiscard]] Failure exact_first_failure(const ExactPolynomial& function, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);
/// Does the same, trying doubles first.
[[nodiscard]] Failure rounded_first_failure(const ExactPolynomial& function, const Instant& now,
                                            KnownAtStart known, StageCounts& stages, TouchPolicy touches);

/// Returns the sign that `exact_sign` computes, at `now` or just after it. Tries doubles first.
[[nodiscard]] int rounded_sign(const ExactPolynomial& function, const Instant& now,
                               int (*exact_sign)(const ExactPolynomial&, ExactTime&));

}  // namespace kds
