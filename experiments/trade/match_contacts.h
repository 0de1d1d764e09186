#pragma once
// The contacts of two runs, one beside the other: a contact is the time from the beginning of a pair's touch
// to its end.

#include <cstdint>
#include <span>
#include <vector>

#include "experiments/trade/match_events.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

struct ContactTime {
  BeadPair pair;
  double from, to;  ///< in frames of the finest data
};

/// From the events of `contacts` in their order and the pairs in contact at the first frame, `first`; what
/// goes on at the end lasts until `last`. By pairs, then in the order of time.
[[nodiscard]] std::vector<ContactTime> contact_times(std::span<const BeadPair> built,
                                                     std::span<const TimedEvent> events, double first,
                                                     double last);

struct ContactMatch {
  std::uint64_t expected = 0, missed = 0, spurious = 0;
  std::uint64_t timed = 0;                        ///< pairs of contacts whose ends are compared
  double time_error_sum = 0, time_error_max = 0;  ///< of both ends, in frames
};

/// A contact is missed if no contact found of the same pair shares any time with it, to within `slack`
/// frames; one found is spurious likewise. Both as contact_times gives them.
[[nodiscard]] ContactMatch match_contacts(std::span<const ContactTime> expected,
                                          std::span<const ContactTime> found, double slack);

}  // namespace kds
