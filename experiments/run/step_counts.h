#pragma once
// Moves the counts of each step out of the structures, so that memory does not grow with the number of steps.

#include <cstdint>
#include <optional>
#include <vector>

#include "experiments/events/event_places.h"
#include "experiments/run/run_results.h"
#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

class StepCounts {
 public:
  /// `session` and `scene` must outlive this object.
  StepCounts(Session& session, const Scene& scene);

  /// Counts the contacts at the first frame. Call it once the structures have been built.
  void begin();
  /// Folds the events of a finished step, and writes them to `results` if a file takes them.
  void end_step(std::size_t step, RunResults* results);
  /// In the order of the session's structures.
  [[nodiscard]] const std::vector<EventCourse>& courses() const { return courses_; }
  /// Returns the number of pairs in contact at the first frame, or nothing if the session has no contacts.
  [[nodiscard]] std::optional<std::uint64_t> contacts_at_start() const { return contacts_at_start_; }

 private:
  Session& session_;
  const Scene& scene_;
  std::vector<EventCourse> courses_;
  std::optional<std::uint64_t> contacts_at_start_;
};

}  // namespace kds
