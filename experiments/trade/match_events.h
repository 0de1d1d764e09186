#pragma once
// The events of two runs of one structure, one beside the other: which the second has missed, which it has
// invented, and how far apart in time those are that both have.

#include <cstdint>
#include <span>

#include "kds/change.h"

namespace kds {

/// An event and when it happened, in frames of the finest data.
struct TimedEvent {
  double time;
  Change change;
};

struct EventMatch {
  std::uint64_t expected = 0, missed = 0, invented = 0, matched = 0;
  double time_error_sum = 0, time_error_max = 0;  ///< over those that are matched, in frames
};

/// Events match that are the same change and no more than `reach` frames apart: of the same change one after
/// the other, the earliest that can be, in the order of time. Both are in that order.
[[nodiscard]] EventMatch match_events(std::span<const TimedEvent> expected, std::span<const TimedEvent> found,
                                      double reach);

}  // namespace kds
