#pragma once
// The contacts of a run, each a stretch of time from its begin to its end, and which of them last while
// another run of the same motion, with smaller balls, has one of the same beads.
//
// Balls that are smaller meet only while the larger ones do, so that a contact of the smaller lies within one
// of the larger, and within one alone. Times are known by brackets: where those leave several to choose from,
// none is said to hold it.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "kds/event_log.h"
#include "motions/base/bead.h"

namespace kds {

class MetContacts final : public EventListener {
 public:
  using Pair = std::pair<BeadId, BeadId>;
  /// A step, and a time in it before its end.
  using Moment = std::pair<std::size_t, double>;
  struct Contact {
    Pair pair;
    Moment earliest;                                            ///< it begins then or later
    Moment latest{std::numeric_limits<std::size_t>::max(), 0};  ///< and ends by then, or with the run
  };

  void on_event(const Event& event) override;
  /// Its events are printed after the run.
  [[nodiscard]] bool prints_time_of(const Event&) const override { return true; }

  [[nodiscard]] std::span<const Event> events() const { return events_; }  ///< in order
  /// Of one of the events.
  [[nodiscard]] std::size_t contact_of(std::size_t event) const { return contact_of_[event]; }
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }

 private:
  std::vector<Event> events_;
  std::vector<std::size_t> contact_of_;
  std::vector<Contact> contacts_;     // in the order of their begins
  std::map<Pair, std::size_t> open_;  // those without an end
};

/// Whether each contact certainly holds one of those that are `within`.
[[nodiscard]] std::vector<std::uint8_t> holding(std::span<const MetContacts::Contact> contacts,
                                                std::span<const MetContacts::Contact> within);

}  // namespace kds
