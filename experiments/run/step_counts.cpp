#include "experiments/run/step_counts.h"

namespace kds {

StepCounts::StepCounts(Session& session, const Scene& scene)
    : session_(session),
      scene_(scene),
      courses_(session.structures().size(),
               EventCourse(bin_width(scene.step_count(), EventCourse::most_bins))) {}

void StepCounts::begin() { contacts_at_start_ = contacts_at(session_, 0); }

void StepCounts::end_step(std::size_t step, RunResults* results) {
  const FrameStamp stamp = scene_.stamp(step);
  for (std::size_t s = 0; s < courses_.size(); ++s) {
    KineticStructure& structure = *session_.structures()[s];
    std::vector<std::uint64_t>& events_per_step = structure.statistics.events_per_step;
    const std::uint64_t events = events_per_step.empty() ? 0 : events_per_step.back();
    events_per_step.clear();
    courses_[s].add(events, stamp.number);
    if (results != nullptr) results->add_step(stamp, structure.name(), events);
  }
}

}  // namespace kds
