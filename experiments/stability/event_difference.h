#pragma once
// What an approximate history got wrong, against the exact one.

#include <cstdint>
#include <span>

#include "kds/change.h"

namespace kds {

struct TimedChange {
  Change change;
  double lower = 0, upper = 0;  ///< the time lies between, or equals both
};

struct EventDifference {
  std::uint64_t missed = 0;     ///< in the exact history only
  std::uint64_t extra = 0;      ///< in the other only
  double worst_time_error = 0;  ///< among the others, beyond the exact bracket
};

/// Events are matched with events of the same change, in order, so that as few as can be are left over, and
/// then with the least errors. Both histories are in order of time.
[[nodiscard]] EventDifference event_difference(std::span<const TimedChange> exact,
                                               std::span<const TimedChange> other);

}  // namespace kds
