#pragma once
// Times of ours and of a peer in turn: machines drift, so a claim is a ratio of medians beside each other. Of
// the processor, but for work that threads share.

#include <algorithm>
#include <cstddef>
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

/// Of the seconds that `work` reports of a call. Short work is called often enough in a round to be measured,
/// and once before, for caches; of longer work the first call is the first round. Work that takes more than
/// `enough` seconds is called once in all.
template <class Work>
Spread repeated_seconds(std::size_t rounds, const Work& work, double enough = 1) {
  constexpr double least = 1e-3;
  double once = work();
  if (once > enough) return spread_of({once});
  const bool is_short = once < least;
  if (is_short) once = work();  // caches are warm
  const auto calls = static_cast<std::size_t>(std::max(1.0, least / std::max(once, 1e-9)));
  std::vector<double> seconds;
  if (!is_short) seconds.push_back(once);
  while (seconds.size() < rounds) {
    double sum = 0;
    for (std::size_t call = 0; call < calls; ++call) sum += work();
    seconds.push_back(sum / static_cast<double>(calls));
  }
  return spread_of(seconds);
}

}  // namespace kds
