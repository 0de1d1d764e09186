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

#include "experiments/output/spool.h"
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

  /// Calls `visit(event, contact)` for the events in order, `contact` the place of the event's contact.
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
  SpooledRecords<OfContact> events_;  // on disk, as there are many
  std::vector<Contact> contacts_;     // in the order of their begins
  std::map<Pair, std::size_t> open_;  // those without an end
};

/// Whether each contact certainly holds one of those that are `within`.
[[nodiscard]] std::vector<std::uint8_t> holding(std::span<const MetContacts::Contact> contacts,
                                                std::span<const MetContacts::Contact> within);

}  // namespace kds
