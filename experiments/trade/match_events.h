#pragma once
// Compares the events of two runs of one structure: which events the second run missed, which it invented,
// and how far apart in time the common events are.

#include <cstdint>
#include <span>

#include "kds/change.h"

namespace kds {

/// An event and its time in frames of the finest data.
struct TimedEvent {
  double time;
  Change change;
};

struct EventMatch {
  std::uint64_t expected = 0, missed = 0, invented = 0, matched = 0;
  double time_error_sum = 0, time_error_max = 0;  ///< errors over the matched events, in frames
};

/// Matches events. Two events match if they are the same change at most `reach` frames apart. Equal changes
/// are matched in the order of time, each with the earliest possible partner. Both lists must be sorted by
/// time.
[[nodiscard]] EventMatch match_events(std::span<const TimedEvent> expected, std::span<const TimedEvent> found,
                                      double reach);

}  // namespace kds
