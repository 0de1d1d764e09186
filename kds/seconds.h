#pragma once
// Measures what some work takes: wall time, and the processor time of all threads of this process together.
// Other programs on the machine do not add to the processor time.

#include <chrono>
#include <ctime>

namespace kds {

struct Seconds {
  double clock = 0, processor = 0;
};

inline double processor_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
Seconds seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const double used = processor_seconds();
  work();
  const double using_now = processor_seconds();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), using_now - used};
}

}  // namespace kds
