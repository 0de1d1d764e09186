#include "structures/contacts/contact_intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "motions/base/input_error.h"
#include "structures/contacts/contacts.h"

namespace kds {

namespace {

RoundedTime at_frame(const FrameStamp& frame) {
  return {static_cast<double>(frame.number), frame.picoseconds};
}

}  // namespace

ContactIntervals::ContactIntervals(const Simulator& simulator, ContactRule rule, Sink sink)
    : simulator_(simulator), rule_(std::move(rule)), sink_(std::move(sink)) {
  if (!(rule_.gap >= 0 && std::isfinite(rule_.gap)))
    throw std::invalid_argument(fmt::format("a gap of {}: expected a length of time from 0 on", rule_.gap));
}

std::optional<ContactIntervals::Key> ContactIntervals::key_of(const BeadPair& pair) const {
  std::uint32_t a = pair.first, b = pair.second;
  if (!rule_.elements.empty()) {
    a = rule_.elements[a];
    b = rule_.elements[b];
    if (a == b) return std::nullopt;
    if (b < a) std::swap(a, b);
  }
  if (!rule_.chains.empty() && rule_.chains[a] == rule_.chains[b] && b - a < rule_.apart) return std::nullopt;
  return (Key{a} << 32U) | b;
}

StepClock ContactIntervals::clock_of(const FrameStamp& from, const FrameStamp& to) const {
  if (rule_.clock == ContactClock::frames)
    return {static_cast<double>(from.number), static_cast<double>(to.number)};
  if (!from.picoseconds || !to.picoseconds || !(*from.picoseconds < *to.picoseconds))
    throw InputError(
        fmt::format("the time does not advance from frame {} to frame {}; lengths of time need "
                    "frames with ascending times",
                    from.number, to.number));
  return {*from.picoseconds, *to.picoseconds};
}

ContactMoment ContactIntervals::moment_of(const Event& event) const {
  constexpr unsigned bits = 44;  // lengths are as certain as the readings of clocks
  const TimeBracket bracket = canonical_bracket(simulator_.now(), bits);
  return {event.step, bracket.lower, bracket.upper, clock_of(event.from, event.to),
          event.rounded.value_or(RoundedTime{event.frame(), event.picoseconds()})};
}

void ContactIntervals::add_built(std::span<const BeadPair> inner, std::span<const BeadPair> outer,
                                 const FrameStamp& from, const FrameStamp& to) {
  const ContactMoment start{0, 0, 0, clock_of(from, to), at_frame(from)};
  for (const BeadPair& pair : inner) {
    const auto key = key_of(pair);
    if (!key) continue;
    State& state = states_[*key];
    ++state.inner;
    if (std::exchange(state.on, true)) continue;
    state.open_at_start = true;
    state.begin = start;
    ++in_contact_;
  }
  for (const BeadPair& pair : outer)
    if (const auto key = key_of(pair)) ++states_[*key].outer;
}

void ContactIntervals::on_event(const Event& event) {
  if (simulator_.moment() != ended_moment_) tell_ended();
  if (!is_asked(event) || event.change.kind > Contacts<3>::touch) return;
  const auto key = key_of({event.change.ids[0], event.change.ids[1]});
  if (!key) return;
  State& state = states_[*key];
  count(*key, state, event);
  const bool is_known = state.on || state.ended || state.inner + state.outer > 0;
  if (!is_known) states_.erase(*key);
}

/// Counts the pairs of beads within the cutoffs, and begins or ends the contact.
void ContactIntervals::count(Key key, State& state, const Event& event) {
  const bool is_inner = event.structure_index == rule_.inner, is_outer = event.structure_index == rule_.outer;
  switch (static_cast<Contacts<3>::Kind>(event.change.kind)) {
    case Contacts<3>::begin:
      if (is_outer) ++state.outer;
      if (is_inner) ++state.inner;
      // The outer cutoff was left and entered at one time, so it was not left.
      if (is_outer && !is_inner && state.ended && state.end_moment == simulator_.moment())
        begin(key, state, event);
      if (is_inner && !state.on) begin(key, state, event);
      return;
    case Contacts<3>::end:
      if (is_inner) --state.inner;
      if (is_outer && --state.outer == 0 && state.on) end(key, state, event);
      return;
    case Contacts<3>::touch:
      if (!is_inner || state.on) return;
      begin(key, state, event);
      if (state.outer == 0) end(key, state, event);
      return;
    default:
      return;
  }
}

/// Begins an interval. A touch at the first frame may be the end of a contact before it.
void ContactIntervals::start(State& state, const ContactMoment& now) {
  state.begin = now;
  state.open_at_start = now.step == 0 && now.upper == 0;
}

void ContactIntervals::begin(Key key, State& state, const Event& event) {
  const ContactMoment now = moment_of(event);
  if (state.ended) {
    if (state.end_moment != simulator_.moment() && !is_short(state, now)) {
      tell(key, state, false);
      start(state, now);
    }
    state.ended = false;
  } else {
    start(state, now);
  }
  state.on = true;
  ++in_contact_;
}

void ContactIntervals::end(Key key, State& state, const Event& event) {
  state.on = false;
  state.ended = true;
  state.end = moment_of(event);
  state.end_moment = simulator_.moment();
  --in_contact_;
  if (rule_.gap > 0) {
    state.exact_end = simulator_.now().exact_apart();
    if (!state.exact_end) throw std::logic_error("a replayed run has no exact times, which a gap needs");
  } else {
    ended_moment_ = state.end_moment;
    just_ended_.push_back(key);
  }
}

/// Returns whether the absence from the end of the pair's interval until now is shorter than the gap.
bool ContactIntervals::is_short(State& state, const ContactMoment& now) const {
  if (rule_.gap == 0) return false;
  const StepClock &b = state.end.clock, &e = now.clock;
  const double margin =
      0x1p-49 * (std::abs(b.begin) + std::abs(b.end) + std::abs(e.begin) + std::abs(e.end) + rule_.gap);
  const double whole = e.begin - b.begin - rule_.gap;
  if (whole + (now.upper * (e.end - e.begin) - state.end.lower * (b.end - b.begin)) < -margin) return true;
  if (whole + (now.lower * (e.end - e.begin) - state.end.upper * (b.end - b.begin)) > margin) return false;
  std::optional<ExactTime> exact_now = simulator_.now().exact_apart();
  if (!exact_now) throw std::logic_error("a replayed run has no exact times, which a gap needs");
  return compare_span(*state.exact_end, b, *exact_now, e, rule_.gap) < 0;
}

void ContactIntervals::tell(Key key, const State& state, bool open_at_end) {
  sink_({static_cast<std::uint32_t>(key >> 32U), static_cast<std::uint32_t>(key), state.begin, state.end,
         state.open_at_start, open_at_end});
}

void ContactIntervals::tell_ended() {
  for (const Key key : just_ended_) {
    const auto found = states_.find(key);
    if (found == states_.end() || !found->second.ended) continue;  // it went on at that moment
    tell(key, found->second, false);
    found->second.ended = false;
    if (found->second.inner + found->second.outer == 0) states_.erase(found);
  }
  just_ended_.clear();
}

void ContactIntervals::finish(std::size_t last_step, const FrameStamp& from, const FrameStamp& to) {
  tell_ended();
  const ContactMoment last{last_step, 1, 1, clock_of(from, to), at_frame(to)};
  std::vector<Key> keys;
  for (const auto& [key, state] : states_)
    if (state.on || state.ended) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  for (const Key key : keys) {
    State& state = states_[key];
    if (state.on) state.end = last;
    tell(key, state, state.on);
  }
  states_.clear();
  in_contact_ = 0;
}

void ContactIntervals::finish_copy(Sink sink, std::size_t last_step, const FrameStamp& from,
                                   const FrameStamp& to) const {
  ContactIntervals copy(*this);
  copy.sink_ = std::move(sink);
  copy.finish(last_step, from, to);
}

}  // namespace kds
