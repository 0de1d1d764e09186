#pragma once
// The failure-time cascade after its first filter, for one certificate: its function in double with errors,
// however they were found, and what that says.

#include <optional>

#include "certificates/base/failure_time.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/instant.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// Does not hold just after now, as a sign certain all around now tells.
[[nodiscard]] inline Failure failed_at_birth(const Instant& now) {
  return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
}

/// What doubles prove of a certificate with this function, or nothing.
[[nodiscard]] std::optional<Failure> proved_failure(const BoundedFunction& bounded, const Instant& now,
                                                    KnownAtStart known);

/// What doubles say of it where nobody asks for a proof: bounded work.
[[nodiscard]] Failure fast_first_failure(BoundedPolynomial function, const Instant& now, KnownAtStart known,
                                         StageCounts& stages);

}  // namespace kds
