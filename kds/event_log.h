#pragma once
// The log of a run: all events and edits.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kds/event.h"
#include "kds/kinetic_structure.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// An edit of a run (Simulator::make_edit). The changes that follow from an edit are events.
struct Edit {
  enum class Kind : std::uint8_t { insert, erase, change };
  Kind kind = Kind::insert;
  std::size_t structure = 0;       ///< index of the structure, for `insert` and `erase`
  std::vector<BeadId> beads = {};  ///< one bead, or all that change course
  std::vector<double> coordinates =
      {};  ///< of `change`: those of the new curves by bead, control point, axis
  std::size_t step = 0;
  /// The exact time of the edit. If `after_failure`: a time between the edit, which was made at a failure,
  /// and the next failure. A failure's own time may be irrational.
  Dyadic time = {};
  bool after_failure = false;
  std::string where = {};  ///< names an edit of a log in messages
};

/// An edit and its place among the events.
struct LoggedEdit {
  std::size_t events_before = 0;
  Edit edit;
};

/// Keeps all events and edits.
class EventLog final : public EventListener {
 public:
  void on_event(const Event& event) override { events.push_back(event); }
  void on_edit(const Edit& edit) override { edits.push_back({events.size(), edit}); }

  std::vector<Event> events;
  std::vector<LoggedEdit> edits;
};

}  // namespace kds
