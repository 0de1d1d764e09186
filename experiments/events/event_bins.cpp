#include "experiments/events/event_bins.h"

#include <algorithm>

namespace kds {

std::size_t bin_width(std::size_t steps, std::size_t most) {
  return std::max<std::size_t>(1, (steps + most - 1) / most);
}

void EventCourse::add(std::uint64_t events, std::size_t frame) {
  const std::uint64_t before = bins_.empty() ? 0 : bins_.back().cumulative;
  if (steps_ % width_ == 0) bins_.push_back({steps_, 0, frame, 0, 0});
  EventBin& bin = bins_.back();
  ++bin.steps;
  ++steps_;
  bin.events += events;
  bin.cumulative = before + events;
}

}  // namespace kds
