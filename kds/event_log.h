#pragma once
// Events as listeners receive them: every change of a run in order, each a complete record that remains valid
// after the run.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kds/change.h"
#include "kds/rounded_time.h"
#include "kds/statistics.h"
#include "motions/frames/frame_stamp.h"

namespace kds {

struct Event {
  std::size_t step = 0;
  double lower = 0, upper = 0;      ///< the time in the step lies strictly between, or equals both
  std::size_t structure_index = 0;  ///< in the order in which structures were added to the simulator
  Change change;
  std::string_view structure;  ///< the structure's name, in static storage
  EventKind kind;
  FrameStamp from,
      to;  ///< the frames that the step leads from and to; numbers of steps if no frames are known
  /// The time of the event in digits that are all certain. Set only if a listener prints it.
  std::optional<RoundedTime> rounded;

  [[nodiscard]] std::span<const BeadId> ids() const { return {change.ids.data(), change.size}; }
  /// Returns the time counted in frames, with a fraction between two: `rounded` if it is set, otherwise the
  /// middle of the bracket.
  [[nodiscard]] double frame() const {
    return rounded ? rounded->frame
                   : between(static_cast<double>(from.number), static_cast<double>(to.number));
  }
  /// Returns the time in picoseconds likewise, or nothing if one of the two frames has no time.
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
  /// Called while the change is being made: it must not change structures or let time run. If it throws,
  /// the run is over.
  virtual void on_event(const Event& event) = 0;
  /// Returns whether the listener prints the time of this event. The event then carries its time in twelve
  /// certain digits (Event::rounded), which takes exact work if the bracket is wide.
  [[nodiscard]] virtual bool prints_time_of(const Event& event) const {
    static_cast<void>(event);
    return false;
  }
};

/// Keeps all events.
class EventLog final : public EventListener {
 public:
  void on_event(const Event& event) override { events.push_back(event); }

  std::vector<Event> events;
};

}  // namespace kds
