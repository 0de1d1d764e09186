#pragma once
// The stages of the failure-time cascade after its first filter, for one certificate. They work on the
// certificate's function in double with error bounds, however those were computed.

#include <optional>

#include "certificates/base/failure_time.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/instant.h"
#include "certificates/formulas/function_values.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// Returns the failure of a certificate that does not hold just after now: its sign is certainly negative on
/// all of the present bracket.
[[nodiscard]] inline Failure failed_at_birth(const Instant& now) {
  return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
}

/// Returns the failure that doubles prove for a certificate with this function, or nothing.
[[nodiscard]] std::optional<Failure> proved_failure(const BoundedFunction& bounded, const Instant& now,
                                                    KnownAtStart known);

/// Returns the failure as computed in double, without proof. The work is bounded.
[[nodiscard]] Failure fast_first_failure(BoundedPolynomial function, const Instant& now, KnownAtStart known,
                                         StageCounts& stages);

}  // namespace kds
