#pragma once
// Measures time: wall time charged to lanes, and wall and processor time of some work.

#include <chrono>
#include <cstddef>
#include <ctime>
#include <vector>

namespace kds {

/// The time of a clock, charged to one of several lanes at a time.
template <class Clock>
class StopwatchOf {
 public:
  static constexpr std::size_t stopped = static_cast<std::size_t>(-1);

  void add_lane() { seconds_.push_back(0); }
  /// Charges time to `lane` from now on, or to no lane if `stopped`. Returns the previous lane. Reading the
  /// clock takes about 30 ns; it is not read if the lane stays the same.
  std::size_t charge(std::size_t lane) {
    if (lane == lane_) return lane;
    const auto now = Clock::now();
    if (lane_ != stopped) seconds_[lane_] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    const std::size_t before = lane_;
    lane_ = lane;
    return before;
  }
  [[nodiscard]] double seconds(std::size_t lane) const { return seconds_[lane]; }
  void add(std::size_t lane, double seconds) { seconds_[lane] += seconds; }
  void reset() { seconds_.assign(seconds_.size(), 0); }

 private:
  std::vector<double> seconds_{0};
  std::size_t lane_ = stopped;
  typename Clock::time_point since_{};
};

using Stopwatch = StopwatchOf<std::chrono::steady_clock>;

/// Wall time, and the processor time of all threads of this process together. Other programs on the machine
/// do not add to the processor time.
struct Seconds {
  double clock = 0, processor = 0;
};

inline double processor_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Returns what some work takes.
template <class Work>
Seconds seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const double used = processor_seconds();
  work();
  const double using_now = processor_seconds();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), using_now - used};
}

}  // namespace kds
