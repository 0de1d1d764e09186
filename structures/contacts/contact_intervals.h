#pragma once
// The intervals during which pairs are in contact, from the exact events of the structure `contacts`.
//
// A pair is a pair of elements: beads, or groups of beads such as residues. A pair is in contact while any
// two of its beads are. Intervals are closed, so an absence of length zero ends nothing. Two rules change
// what counts as one contact, and both are decided by exact comparison of times:
//
// - Dual cutoff: a contact begins when the pair's least distance falls to the inner cutoff, and ends when it
//   rises above the outer one. The least distance is that of any two beads of the pair, so beads that were
//   never within the inner cutoff can keep a contact. The run then has two structures `contacts`, one for
//   each cutoff.
// - Gap: an absence shorter than the gap does not end a contact.
//
// A contact that lasts at the first or the last frame is open there: its true length is unknown and at least
// the length of the interval. A pair that starts between the two cutoffs is not in contact. A pair that comes
// to the cutoff exactly at the last frame is not in contact, because events at a frame belong to the step
// that begins there. examples/contact_lifetimes.cpp is a run with such intervals.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "certificates/exact/time_span.h"
#include "kds/event.h"
#include "kds/simulator.h"
#include "motions/frames/frame_stamp.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// The clock by which lengths of time are measured.
enum class ContactClock : std::uint8_t { frames, picoseconds };

/// Frames are divided into ticks, at which the samples of frame_contacts.h lie.
inline constexpr std::size_t ticks_per_frame = 256;

/// An end of an interval.
struct ContactMoment {
  std::size_t step = 0;
  double lower = 0, upper = 0;  ///< canonical bracket of the parameter in the step, no wider than 2^-44
  StepClock clock;              ///< readings at the ends of the step
  RoundedTime rounded;          ///< twelve certain digits if ContactRule::rounds_times

  [[nodiscard]] double u() const { return 0.5 * (lower + upper); }
  /// Return the last tick of the run that is not after this time, and the first that is not before.
  [[nodiscard]] std::size_t tick_before() const {
    return step * ticks_per_frame + static_cast<std::size_t>(std::floor(lower * double{ticks_per_frame}));
  }
  [[nodiscard]] std::size_t tick_after() const {
    return step * ticks_per_frame + static_cast<std::size_t>(std::ceil(upper * double{ticks_per_frame}));
  }
};

struct ContactInterval {
  std::uint32_t first = 0, second = 0;  ///< elements, first < second
  ContactMoment begin, end;
  bool open_at_start = false, open_at_end = false;

  /// Returns the length in units of the clock. The error is a few units in the last place of the readings.
  [[nodiscard]] double length() const {
    const StepClock &b = begin.clock, &e = end.clock;
    return (e.begin - b.begin) + (end.u() * (e.end - e.begin) - begin.u() * (b.end - b.begin));
  }
};

struct ContactRule {
  /// The element of each bead. Contacts between beads of one element do not count. Empty: each bead is one.
  std::vector<std::uint32_t> elements = {};
  /// The chain of each element. Two elements of one chain count if their numbers differ by at least `apart`.
  /// Empty: all pairs of elements count.
  std::vector<std::uint32_t> chains = {};
  std::uint32_t apart = 1;
  double gap = 0;  ///< in units of the clock
  ContactClock clock = ContactClock::frames;
  std::size_t inner = 0, outer = 0;  ///< indices of the structures; equal unless there are two cutoffs
  bool rounds_times = true;          ///< whether ends get twelve certain digits, which takes exact work
};

class ContactIntervals final : public EventListener {
 public:
  using Sink = std::function<void(const ContactInterval&)>;

  /// The simulator must outlive the listener. Each interval goes to `sink`, at the first event of the run
  /// after the interval's end, or after the gap. Intervals of one pair arrive in their order. Throws
  /// std::invalid_argument if the gap is negative or not finite.
  ContactIntervals(const Simulator& simulator, ContactRule rule, Sink sink);

  /// Adds the pairs of beads in contact at the first frame, within the inner and the outer cutoff. With one
  /// cutoff, both are the same. `from` and `to` are the frames of the first step. Must come before any event.
  void add_built(std::span<const BeadPair> inner, std::span<const BeadPair> outer, const FrameStamp& from,
                 const FrameStamp& to);
  void on_event(const Event& event) override;
  [[nodiscard]] bool prints_time_of(const Event& event) const override {
    return rule_.rounds_times && is_asked(event);
  }
  [[nodiscard]] bool reads_exact_time_of(const Event& event) const override { return is_asked(event); }
  /// Ends all open contacts at the end of the run's last step, which leads from one of these frames to the
  /// other. Call it once.
  void finish(std::size_t last_step, const FrameStamp& from, const FrameStamp& to);
  /// Passes to `sink` what `finish` would pass on if the run ended here, between two steps. The run goes on
  /// undisturbed.
  void finish_copy(Sink sink, std::size_t last_step, const FrameStamp& from, const FrameStamp& to) const;

  /// Returns the number of pairs in contact now.
  [[nodiscard]] std::size_t size() const { return in_contact_; }

 private:
  /// A pair that has been in contact.
  struct State {
    std::uint32_t inner = 0, outer = 0;  // pairs of beads within each cutoff
    bool on = false, ended = false;      // ended: `end` is the end of an interval that may go on
    bool open_at_start = false;
    std::uint64_t end_moment = 0;  // Simulator::moment of `end`
    ContactMoment begin, end;
    std::optional<ExactTime> exact_end;  // if there is a gap
  };
  using Key = std::uint64_t;

  [[nodiscard]] bool is_asked(const Event& event) const {
    return event.structure_index == rule_.inner || event.structure_index == rule_.outer;
  }
  [[nodiscard]] std::optional<Key> key_of(const BeadPair& pair) const;
  [[nodiscard]] StepClock clock_of(const FrameStamp& from, const FrameStamp& to) const;
  [[nodiscard]] ContactMoment moment_of(const Event& event) const;
  void count(Key key, State& state, const Event& event);
  static void start(State& state, const ContactMoment& now);
  void begin(Key key, State& state, const Event& event);
  void end(Key key, State& state, const Event& event);
  [[nodiscard]] bool is_short(State& state, const ContactMoment& now) const;
  void tell(Key key, const State& state, bool open_at_end);
  /// Tells the intervals that ended at an earlier moment.
  void tell_ended();

  const Simulator& simulator_;
  ContactRule rule_;
  Sink sink_;
  std::unordered_map<Key, State> states_;
  std::vector<Key> just_ended_;  // at `ended_moment_`; unused if there is a gap
  std::uint64_t ended_moment_ = 0;
  std::size_t in_contact_ = 0;
};

}  // namespace kds
