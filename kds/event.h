#pragma once
// The history of a run: events as listeners receive them, their times in decimal digits, and the fingerprint.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "certificates/exact/instant.h"
#include "kds/kinetic_structure.h"
#include "motions/frames/frame_stamp.h"

namespace kds {

struct Edit;

/// A time on a scale that runs from one frame to the next, rounded to twelve significant digits (half to
/// even). A number printed with `{:.12g}` shows these digits.
struct RoundedTime {
  double frame = 0;                   ///< counted in frames, with a fraction between two frames
  std::optional<double> picoseconds;  ///< empty if a frame has no time
};

/// Rounds `now`, a time in the step between two frames. Narrows a copy of the exact root behind `now` until
/// all digits are certain. Ties of the rounding are decided exactly, so the function always ends. Returns
/// fewer digits if only a bracket is known (a replayed time).
[[nodiscard]] RoundedTime rounded_time(const Instant& now, const FrameStamp& from, const FrameStamp& to);

/// A time in a step, which lies strictly between both numbers or equals both.
struct TimeBracket {
  double lower = 0, upper = 0;

  friend bool operator==(const TimeBracket&, const TimeBracket&) = default;
};

/// Brackets of events end at multiples of 2^-event_bits. Searches leave brackets of up to 2^-24. The finer
/// the grid is, the more often a number of the grid lies in such a bracket, which takes exact work: for 3% of
/// the flips of a power diagram with 24 bits, for all of them with 40.
inline constexpr unsigned event_bits = 24;

/// Returns the canonical bracket of a time, which depends on the time alone and not on how a search found it:
/// the time itself, twice, if it is a multiple of 2^-bits, otherwise its two neighbours among these
/// multiples. `bits` is at most 52. Takes exact work if a multiple lies in the bracket of `now`, which is
/// not narrowed. If then only a bracket is known (a replayed time), returns this bracket.
[[nodiscard]] TimeBracket canonical_bracket(const Instant& now, unsigned bits = event_bits);

/// A change of a structure as listeners receive it: a complete record that remains valid after the run.
struct Event {
  std::size_t step = 0;
  double lower = 0, upper = 0;      ///< canonical bracket of the time in the step
  std::size_t structure_index = 0;  ///< in the order in which structures were added to the simulator
  Change change;
  std::string_view structure;  ///< the structure's name, in static storage
  EventKind kind;
  /// The frames that the step leads from and to; numbers of steps if no frames are known.
  FrameStamp from, to;
  /// The time of the event in digits that are all certain. Set only if a listener prints it.
  std::optional<RoundedTime> rounded;
  /// The stage that decided the time of the event, which is the time of the last failure handled. It is
  /// unknown if no failure led there, as for repairs at the start of a step or edits between failures.
  DecidedBy decided_by = DecidedBy::unknown;

  [[nodiscard]] std::span<const BeadId> ids() const { return {change.ids.data(), change.size}; }
  /// Returns the time counted in frames, with a fraction between two: `rounded` if it is set, otherwise the
  /// middle of the bracket.
  [[nodiscard]] double frame() const {
    return rounded ? rounded->frame
                   : between(static_cast<double>(from.number), static_cast<double>(to.number));
  }
  /// Returns the time in picoseconds in the same way, or nothing if one of the two frames has no time.
  [[nodiscard]] std::optional<double> picoseconds() const {
    if (!from.picoseconds || !to.picoseconds) return std::nullopt;
    if (rounded) return rounded->picoseconds;
    return between(*from.picoseconds, *to.picoseconds);
  }
  /// Calls `visit(role, ids)` for each role that ids are in.
  template <class Visit>
  void for_roles(Visit visit) const {
    std::size_t first = 0;
    for (const IdRole& role : kind.roles) {
      const std::size_t left = ids().size() - first;
      const std::size_t count = role.count == 0 || role.count > left ? left : role.count;
      if (count > 0) visit(role, ids().subspan(first, count));
      first += count;
    }
  }

 private:
  [[nodiscard]] double between(double begin, double end) const {
    return begin + 0.5 * (lower + upper) * (end - begin);
  }
};

class EventListener {
 public:
  virtual ~EventListener() = default;
  /// Called while the change is being made: it must not change structures or let time run. If the listener
  /// throws, the run is over.
  virtual void on_event(const Event& event) = 0;
  /// Returns whether the listener prints the time of this event. The event then carries its time in twelve
  /// certain digits (Event::rounded), which takes exact work if the bracket is wide.
  [[nodiscard]] virtual bool prints_time_of(const Event& event) const {
    static_cast<void>(event);
    return false;
  }
  /// Returns whether the listener asks Simulator::now for the exact time of this event. In a run on several
  /// threads, exact times are known only for such events.
  [[nodiscard]] virtual bool reads_exact_time_of(const Event& event) const {
    static_cast<void>(event);
    return false;
  }
  /// Called for each edit (kds/event_log.h), before the events that it causes. The rules of `on_event` hold.
  virtual void on_edit(const Edit& edit) { static_cast<void>(edit); }
};

/// A hash of 32-bit words in their order: FNV-1a with the final mix of splitmix64.
class WordHash {
 public:
  void add(std::uint32_t word) { hash_ = (hash_ ^ word) * 0x100000001b3ULL; }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t x = hash_ + 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// A hash of the order of events and their combinatorial changes, never of doubles. Equal histories have
/// equal fingerprints on every kernel, run and machine.
///
/// The fingerprint is the sum, modulo 2^64, of one WordHash for each step that has events. The hash of a step
/// takes the step's number and then its changes in order. So parts of a run that consist of whole steps may
/// be hashed separately and joined in any order. A history without events has the fingerprint 0.
class Fingerprint {
 public:
  /// Adds the next change. The changes of one step must be added one after the other.
  void add(std::uint32_t step, std::uint32_t structure, const Change& change) {
    if (!in_step_ || step != step_) begin(step);
    hash_.add(structure);
    hash_.add(change.kind);
    for (std::uint8_t i = 0; i < change.size; ++i) hash_.add(change.ids[i]);
  }
  /// Adds a history of other steps.
  void join(const Fingerprint& other) { sum_ += other.value(); }
  [[nodiscard]] std::uint64_t value() const { return in_step_ ? sum_ + hash_.value() : sum_; }

 private:
  void begin(std::uint32_t step) {
    sum_ = value();
    in_step_ = true;
    step_ = step;
    hash_ = {};
    hash_.add(step);
  }

  std::uint64_t sum_ = 0;  // sum of the hashes of the steps before `step_`
  bool in_step_ = false;
  std::uint32_t step_ = 0;
  WordHash hash_;
};

}  // namespace kds
