#include "experiments/trade/match_events.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

namespace kds {

namespace {

using Key = std::tuple<std::uint8_t, std::uint8_t, std::array<BeadId, 10>>;

std::map<Key, std::vector<double>> times_by_change(std::span<const TimedEvent> events) {
  std::map<Key, std::vector<double>> times;
  for (const TimedEvent& event : events)
    times[{event.change.kind, event.change.size, event.change.ids}].push_back(event.time);
  return times;
}

void match(std::span<const double> expected, std::span<const double> found, double reach, EventMatch& match) {
  std::size_t e = 0, f = 0;
  while (e < expected.size() && f < found.size()) {
    const double apart = std::abs(expected[e] - found[f]);
    if (apart <= reach) {
      ++match.matched;
      match.time_error_sum += apart;
      match.time_error_max = std::max(match.time_error_max, apart);
      ++e, ++f;
    } else if (expected[e] < found[f]) {
      ++match.missed, ++e;
    } else {
      ++match.invented, ++f;
    }
  }
  match.missed += expected.size() - e;
  match.invented += found.size() - f;
}

}  // namespace

EventMatch match_events(std::span<const TimedEvent> expected, std::span<const TimedEvent> found,
                        double reach) {
  const auto of_expected = times_by_change(expected), of_found = times_by_change(found);
  EventMatch result;
  result.expected = expected.size();
  for (const auto& [change, times] : of_expected) {
    const auto same = of_found.find(change);
    match(times, same == of_found.end() ? std::span<const double>() : std::span(same->second), reach, result);
  }
  for (const auto& [change, times] : of_found) {
    if (!of_expected.contains(change)) result.invented += times.size();
  }
  return result;
}

}  // namespace kds
