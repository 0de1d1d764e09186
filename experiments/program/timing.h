#pragma once
// Measures our code and a peer in turn. Because the speed of a machine drifts, a claim is a ratio of medians
// measured side by side. The time is processor time, except for work that several threads share.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "kds/stopwatch.h"

namespace kds {

/// For work that cannot be repeated; otherwise use processor_seconds_per_call.
template <class Work>
double processor_seconds_of(const Work& work) {
  return seconds_of<ProcessorClock>(work);
}
template <class Work>
double processor_seconds_per_call(const Work& work) {
  return seconds_per_call<ProcessorClock>(work);
}

/// Returns 0 for no values.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median, least and largest of several rounds.
struct Spread {
  double median = 0, least = 0, most = 0;
};
inline Spread spread_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {median_of(values), *least, *most};
}

/// Returns "0.210 (0.204 to 0.233)", or "0.210" for a single round, which has no spread.
[[nodiscard]] std::string spread_text(const Spread& spread);

/// Runs the works in turn, since the speed of a machine drifts. Returns the seconds of each work by round.
/// Work that takes more than a second is done in the first round only.
[[nodiscard]] std::vector<std::vector<double>> seconds_in_turn(
    std::size_t rounds, const std::vector<std::function<double()>>& works);

/// Returns the ratio of `seconds` to `others`, round by round. A work that was called only once is compared
/// with every round of the other.
[[nodiscard]] Spread ratios_by_round(const std::vector<double>& seconds, const std::vector<double>& others);

}  // namespace kds
