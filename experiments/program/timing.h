#pragma once
// Times of ours and of a peer in turn: machines drift, so a claim is a ratio of medians beside each other. Of
// the processor, but for work that threads share.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "kds/seconds.h"

namespace kds {

template <class Work>
double processor_seconds_of(const Work& work) {
  return seconds_of(work).processor;
}

inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What several rounds gave.
struct Spread {
  double median = 0, least = 0, most = 0;
};
inline Spread spread_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {median_of(values), *least, *most};
}

/// "0.210 (0.204 to 0.233)"; of one round, which has no spread, "0.210".
[[nodiscard]] std::string spread_text(const Spread& spread);

/// Seconds of a call, as `work` reports them. Short work is called often enough in a round to be measured,
/// and once before, for caches; of longer work the first call is the first round. Work that takes more than
/// `enough` seconds is called once in all.
[[nodiscard]] Spread repeated_seconds(std::size_t rounds, std::function<double()> work, double enough = 1);

/// The same of each work in turn, for machines drift: its seconds by round.
[[nodiscard]] std::vector<std::vector<double>> seconds_in_turn(std::size_t rounds,
                                                               std::vector<std::function<double()>> works);

/// How many times as long as the others a work took, round by round. What was called once stands beside every
/// round of the other.
[[nodiscard]] Spread ratios_by_round(const std::vector<double>& seconds, const std::vector<double>& others);

}  // namespace kds
