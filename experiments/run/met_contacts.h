#pragma once
// Records the contacts of a run. Each contact is an interval of time from its begin to its end. `holding`
// then tells which contacts contain a contact of the same beads in another run of the same motion with
// smaller balls.
//
// Smaller balls meet only while the larger balls meet, so a contact of the smaller balls lies within exactly
// one contact of the larger balls. Times are known only as brackets. If the brackets leave several
// candidates, no candidate is reported as the container.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "experiments/output/spool.h"
#include "kds/event_log.h"
#include "motions/base/bead.h"

namespace kds {

class MetContacts final : public EventListener {
 public:
  using Pair = std::pair<BeadId, BeadId>;
  /// A step, and a time within the step before its end.
  using Moment = std::pair<std::size_t, double>;
  struct Contact {
    Pair pair;
    Moment earliest;  ///< lower bound of the begin
    /// Upper bound of the end. The default means that the contact lasts to the end of the run.
    Moment latest{std::numeric_limits<std::size_t>::max(), 0};
  };

  void on_event(const Event& event) override;
  /// Returns true because the events are printed after the run.
  [[nodiscard]] bool prints_time_of(const Event&) const override { return true; }

  /// Calls `visit(event, contact)` for the events in order. `contact` is the index of the event's contact.
  template <class Visit>
  void for_each_event(const Visit& visit) const {
    events_.for_each([&](const OfContact& record) { visit(record.event, record.contact); });
  }
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }

 private:
  struct OfContact {
    Event event;
    std::size_t contact;
  };
  SpooledRecords<OfContact> events_;  // on disk, since there are many events
  std::vector<Contact> contacts_;     // ordered by their begins
  std::map<Pair, std::size_t> open_;  // contacts that have not ended
};

/// Returns for each element of `contacts` whether it certainly contains an element of `within`.
[[nodiscard]] std::vector<std::uint8_t> holding(std::span<const MetContacts::Contact> contacts,
                                                std::span<const MetContacts::Contact> within);

}  // namespace kds
