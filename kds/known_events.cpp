#include "kds/known_events.h"

#include <stdexcept>
#include <utility>

#include "kds/kinetic_structure.h"
#include "motions/base/interruption.h"
#include "motions/base/require_index.h"

namespace kds {

namespace {

/// Calls `visit` with the edits at the front of `edits` that have at most `events_before` events before them,
/// and removes these edits from the span.
template <class Visit>
void take_edits(std::span<const LoggedEdit>& edits, std::size_t events_before, const Visit& visit) {
  for (; !edits.empty() && edits.front().events_before <= events_before; edits = edits.subspan(1))
    visit(edits.front().edit);
}

}  // namespace

void KnownEvents::build_for_replay() {
  simulator_.recording_ = false;
  simulator_.build();
  simulator_.recording_ = true;
}

void KnownEvents::replay_step(std::span<const ReplayedEvent> events, std::span<const LoggedEdit> edits,
                              const std::function<void(const Edit&)>& set_curves) {
  Simulator& s = simulator_;
  const Simulator::ComputeScope scope(s);
  s.require(Simulator::Phase::between_steps, "a step");
  s.begin_step();
  const auto follow = [&set_curves](const Edit& edit) {
    if (edit.kind == Edit::Kind::change) set_curves(edit);
  };
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ReplayedEvent& event = events[i];
    InterruptionCheck::ask();
    take_edits(edits, i, follow);
    s.now_ = Instant(FailureTime{event.lower, event.upper, 0, false});
    s.watch_.charge(Simulator::lane_of(event.structure));
    try {
      s.structures_[event.structure]->apply(event.change);
    } catch (const std::invalid_argument& reason) {
      throw std::invalid_argument(event.where + ": " + reason.what());
    }
    s.record(event.structure, event.change);
    s.watch_.charge(Simulator::engine_lane);
  }
  take_edits(edits, events.size(), follow);
  s.finish_step();
}

void KnownEvents::start_at(std::size_t step) {
  simulator_.require(Simulator::Phase::new_run, "start_at()");
  simulator_.step_ = step;
}

RelayedEvent KnownEvents::event_to_relay(const Event& event, bool first_at_its_time, bool exact) const {
  const ScheduledFailure& present = simulator_.present_;
  RelayedEvent relayed{static_cast<std::uint32_t>(event.structure_index),
                       first_at_its_time,
                       event.decided_by,
                       event.change,
                       {event.lower, event.upper},
                       nullptr};
  const bool has_function = exact && event.lower < event.upper && present.source != nullptr;
  if (has_function || event.rounded) {
    ExactFunction function = has_function ? present.source->exact_function(present.slot) : nullptr;
    relayed.certain = std::make_unique<RelayedEvent::Certain>(
        RelayedEvent::Certain{std::move(function), present.time, event.rounded});
  }
  return relayed;
}

void KnownEvents::relay(std::size_t step, const FrameStamp& from, const FrameStamp& to,
                        std::span<const RelayedEvent> events, std::span<const LoggedEdit> edits) {
  Simulator& s = simulator_;
  const Simulator::ComputeScope scope(s);
  s.require(Simulator::Phase::new_run, "relay()");
  s.step_ = step;
  s.set_frames(from, to);
  const std::size_t before = s.watch_.charge(Simulator::listener_lane);
  const auto notify = [&s](const Edit& edit) { s.notify(edit); };
  for (std::size_t i = 0; i < events.size(); ++i) {
    const RelayedEvent& event = events[i];
    InterruptionCheck::ask();
    take_edits(edits, i, notify);
    require_index("structure", event.structure, s.structures_.size());
    if (event.first_at_its_time) ++s.moment_;
    s.held_.function = event.certain ? event.certain->function : nullptr;
    s.now_ = s.held_.function ? Instant(event.certain->time, s.held_, 0)
                              : Instant(FailureTime{event.bracket.lower, event.bracket.upper, 0, false});
    s.notify(event.structure, event.change, event.bracket, event.decided_by,
             [&event] { return event.certain ? event.certain->rounded : std::nullopt; });
  }
  take_edits(edits, events.size(), notify);
  s.watch_.charge(before);
}

void KnownEvents::join(const Simulator& part) {
  Simulator& s = simulator_;
  const Simulator::ComputeScope scope(s);
  if (part.structures_.size() != s.structures_.size())
    throw std::logic_error("a simulator joins another one with other structures");
  s.fingerprint_.join(part.fingerprint_);
  s.order_.add(part.order_.counts());
  ExactWork::spend(part.work_.done());
  s.watch_.add(Simulator::engine_lane, part.watch_.seconds(Simulator::engine_lane));
  for (std::size_t k = 0; k < s.structures_.size(); ++k)
    s.watch_.add(Simulator::lane_of(k), part.seconds_of(k));
}

}  // namespace kds
