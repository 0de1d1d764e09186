#include "experiments/stability/event_difference.h"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

namespace kds {
namespace {

struct Times {
  std::vector<TimedChange> exact, other;
};

double error(const TimedChange& exact, const TimedChange& other) {
  const double time = 0.5 * (other.lower + other.upper);
  return std::max({0.0, exact.lower - time, time - exact.upper});
}

// Matches each event of the shorter history, in order, with an event of the longer one. Returns the smallest
// possible worst error.
double least_worst_error(const Times& times) {
  const bool fewer_exact = times.exact.size() <= times.other.size();
  const std::size_t rows = std::min(times.exact.size(), times.other.size());
  const std::size_t columns = std::max(times.exact.size(), times.other.size());
  // worst[j] is the least worst error for the first i events of the shorter and the first j events of the
  // longer history.
  std::vector<double> worst(columns + 1, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    double diagonal = worst[0];
    worst[0] = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < columns; ++j) {
      const double pair = error(times.exact[fewer_exact ? i : j], times.other[fewer_exact ? j : i]);
      const double matched = std::max(diagonal, pair);
      diagonal = worst[j + 1];
      worst[j + 1] = std::min(worst[j], matched);
    }
  }
  return worst[columns];
}

}  // namespace

EventDifference event_difference(std::span<const TimedChange> exact, std::span<const TimedChange> other) {
  std::map<std::vector<BeadId>, Times> by_change;
  const auto times_of = [&by_change](const Change& change) -> Times& {
    std::vector<BeadId> key{change.kind};
    key.insert(key.end(), change.ids.begin(), change.ids.begin() + change.size);
    return by_change[key];
  };
  for (const TimedChange& event : exact) times_of(event.change).exact.push_back(event);
  for (const TimedChange& event : other) times_of(event.change).other.push_back(event);

  EventDifference difference;
  for (const auto& [key, times] : by_change) {
    const std::size_t n = times.exact.size(), m = times.other.size();
    difference.missed += n > m ? n - m : 0;
    difference.extra += m > n ? m - n : 0;
    if (n > 0 && m > 0)
      difference.worst_time_error = std::max(difference.worst_time_error, least_worst_error(times));
  }
  return difference;
}

}  // namespace kds
