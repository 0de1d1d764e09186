#pragma once
// Compares the events, and the contacts, of two runs of one structure: which the second run missed, which it
// invented, and how far apart in time the common ones are.

#include <cstdint>
#include <span>
#include <vector>

#include "kds/kinetic_structure.h"
#include "structures/necklace/bead_pairs.h"

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

// A contact is the interval from the time at which a pair begins to touch to the time at which it parts.

struct ContactTime {
  BeadPair pair;
  double from, to;  ///< in frames of the finest data
};

/// Returns the contacts, sorted by pair and then by time. `built` has the pairs in contact at the first
/// frame, which has the time `first`. `events` are the events of the structure `contacts` in their order.
/// Contacts that last to the end get the end time `last`.
[[nodiscard]] std::vector<ContactTime> contact_times(std::span<const BeadPair> built,
                                                     std::span<const TimedEvent> events, double first,
                                                     double last);

struct ContactMatch {
  std::uint64_t expected = 0, missed = 0, spurious = 0;
  std::uint64_t timed = 0;                        ///< number of contact pairs whose ends are compared
  double time_error_sum = 0, time_error_max = 0;  ///< errors of both ends, in frames
};

/// Matches contacts. An expected contact is missed if no found contact of the same pair overlaps it to within
/// `margin` frames. A found contact is spurious if no expected contact of the same pair overlaps it to within
/// `margin` frames. Both lists must be sorted as contact_times sorts them.
[[nodiscard]] ContactMatch match_contacts(std::span<const ContactTime> expected,
                                          std::span<const ContactTime> found, double margin);

}  // namespace kds
