#pragma once
// Times of ours and of a peer in turn: machines drift, so a claim is a ratio of medians beside each other.
// Processor time of the process: other programs on the machine do not count.

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace kds {

inline double processor_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double processor_seconds_of(const Work& work) {
  const double start = processor_seconds();
  work();
  return processor_seconds() - start;
}

inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace kds
