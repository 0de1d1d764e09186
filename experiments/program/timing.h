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

}  // namespace kds
