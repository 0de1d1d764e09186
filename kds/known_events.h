#pragma once
// Steps whose events are known: from a log, or from simulators that run other steps of the same run. Such
// steps have no certificates and no queue. The main loop is run_events in simulator.cpp.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "kds/event_log.h"
#include "kds/simulator.h"

namespace kds {

/// A logged event to be replayed. `where` names it in messages.
struct ReplayedEvent {
  std::size_t structure;
  double lower, upper;
  Change change;
  std::string where;
};

/// An event of one simulator that another one passes to its listeners. A run may have millions.
struct RelayedEvent {
  std::uint32_t structure;
  bool first_at_its_time;  ///< whether no event was relayed at this very time before
  DecidedBy decided_by;
  Change change;
  TimeBracket bracket;
  struct Certain {
    ExactFunction function;  ///< `time` is its root
    FailureTime time;
    std::optional<RoundedTime> rounded;
  };
  /// Null if no listener asks for what it holds. The function is null if the time is a double.
  std::unique_ptr<const Certain> certain;
};

/// Makes changes in a simulator whose events are known. The simulator must outlive this object.
class KnownEvents {
 public:
  explicit KnownEvents(Simulator& simulator) : simulator_(simulator) {}

  /// Like Simulator::build and run_step, but the changes come from a log. Throws std::invalid_argument, with
  /// the event's `where`, if a change cannot be made.
  void build_for_replay();
  /// Calls `set_curves` with each change of course, after the events that come before it in the log.
  void replay_step(std::span<const ReplayedEvent> events, std::span<const LoggedEdit> edits,
                   const std::function<void(const Edit&)>& set_curves);
  void replay_step(std::span<const ReplayedEvent> events) { replay_step(events, {}, {}); }

  // A run in parts (structures/session/parallel_run.h): several simulators run some steps each. Another
  // simulator, whose structures only have names, joins them.

  /// Sets the number of the first step. Throws std::logic_error once the structures are built.
  void start_at(std::size_t step);
  /// Returns a copy of the present event that another simulator can relay.
  [[nodiscard]] RelayedEvent event_to_relay(const Event& event, bool first_at_its_time, bool exact) const;
  /// Notifies the listeners of the events and edits of a step that another simulator ran. The events are not
  /// counted.
  void relay(std::size_t step, const FrameStamp& from, const FrameStamp& to,
             std::span<const RelayedEvent> events, std::span<const LoggedEdit> edits = {});
  /// Adds the fingerprint, comparisons, exact work and seconds of another simulator, which has run other
  /// steps with the same structures.
  void join(const Simulator& part);

 private:
  Simulator& simulator_;
};

}  // namespace kds
