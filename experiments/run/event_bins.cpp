#include "experiments/run/event_bins.h"

#include <algorithm>

namespace kds {

std::size_t bin_width(std::size_t steps, std::size_t most) {
  return std::max<std::size_t>(1, (steps + most - 1) / most);
}

std::vector<EventBin> bin_events(std::span<const std::uint64_t> events_per_step, std::size_t width) {
  std::vector<EventBin> bins;
  std::uint64_t cumulative = 0;
  for (std::size_t step = 0; step < events_per_step.size(); ++step) {
    if (step % width == 0) bins.push_back({step, 0, 0, 0});
    EventBin& bin = bins.back();
    ++bin.steps;
    bin.events += events_per_step[step];
    bin.cumulative = cumulative += events_per_step[step];
  }
  return bins;
}

}  // namespace kds
