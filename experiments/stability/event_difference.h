#pragma once
// Counts the errors of an approximate history against the exact history.

#include <cstdint>
#include <span>

#include "kds/change.h"

namespace kds {

struct TimedChange {
  Change change;
  double lower = 0, upper = 0;  ///< the time lies strictly between both, or equals both
};

struct EventDifference {
  std::uint64_t missed = 0;     ///< events only in the exact history
  std::uint64_t extra = 0;      ///< events only in the other history
  double worst_time_error = 0;  ///< largest error of the matched events outside the exact bracket
};

/// Matches each event with an event of the same change, in order. Leaves as few events as possible unmatched,
/// then minimizes the errors. Both histories are in order of time.
[[nodiscard]] EventDifference event_difference(std::span<const TimedChange> exact,
                                               std::span<const TimedChange> other);

}  // namespace kds
