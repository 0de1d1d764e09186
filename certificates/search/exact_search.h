#pragma once
// The exact stage of the failure-time cascade: a polynomial's first failure on integers.

#include "certificates/base/failure_time.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"

namespace kds {

/// The exact failure, a root of `function`, as a bracket in doubles.
[[nodiscard]] Failure to_failure(const ExactPolynomial& function, ExactFailure& root);

[[nodiscard]] Failure exact_first_failure(const ExactPolynomial& function, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);

}  // namespace kds
