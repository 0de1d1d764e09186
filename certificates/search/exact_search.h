#pragma once
// The exact stage of the failure-time cascade: a polynomial's first failure, its coefficients being whole
// numbers. Its roots are found in double where these are precise enough, else on integers.

#include "certificates/base/failure_time.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// The exact failure, a root of `function`, as a bracket in doubles.
[[nodiscard]] Failure to_failure(const ExactPolynomial& function, ExactFailure& root);

[[nodiscard]] Failure exact_first_failure(const ExactPolynomial& function, const Instant& now,
                                          StageCounts& stages, TouchPolicy touches = TouchPolicy::ignored);
/// The same, in double first.
[[nodiscard]] Failure rounded_first_failure(const ExactPolynomial& function, const Instant& now,
                                            KnownAtStart known, StageCounts& stages, TouchPolicy touches);

/// The sign at `now` or just after it, whichever `exact_sign` finds: in double first.
[[nodiscard]] int rounded_sign(const ExactPolynomial& function, const Instant& now,
                               int (*exact_sign)(const ExactPolynomial&, ExactTime&));

}  // namespace kds
