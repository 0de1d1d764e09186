#pragma once
// Measures time: wall time charged to lanes, and the time of some work.
//
// Reading a clock takes time: about 30 ns for wall time, and 0.3 to 2 us for processor time, which needs a
// system call. This time would be part of each measurement. It is found by reading the clock many times and
// then subtracted. The remaining error is the variation of a reading, about a tenth of its time.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <vector>

namespace kds {

/// Wall time since a fixed moment.
struct WallClock {
  static std::int64_t nanoseconds() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
};

/// Processor time of all threads of this process together. Other programs on the machine do not add to it.
struct ProcessorClock {
  static std::int64_t nanoseconds() {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return std::int64_t{1000000000} * t.tv_sec + t.tv_nsec;
  }
};

/// Returns the nanoseconds by which a reading lengthens what is measured: the median of 101, found once.
template <class Clock>
std::int64_t nanoseconds_of_reading() {
  static const std::int64_t median = [] {
    std::array<std::int64_t, 101> readings{};
    for (std::int64_t& reading : readings) {
      const std::int64_t start = Clock::nanoseconds();
      reading = Clock::nanoseconds() - start;
    }
    const auto middle = readings.begin() + readings.size() / 2;
    std::nth_element(readings.begin(), middle, readings.end());
    return *middle;
  }();
  return median;
}

/// Returns the seconds that some work takes, at least a nanosecond. Use seconds_per_call for short work that
/// can be repeated.
template <class Clock, class Work>
double seconds_of(const Work& work) {
  const std::int64_t start = Clock::nanoseconds();
  work();
  const std::int64_t end = Clock::nanoseconds();
  return 1e-9 * static_cast<double>(std::max<std::int64_t>(1, end - start - nanoseconds_of_reading<Clock>()));
}

/// Returns the seconds of one call of `work`, which must do the same at each call. Calls it 1, 2, 4, 8 ...
/// times until a reading of the clock takes less than a hundredth of these calls, twice in a row, because a
/// machine that pauses may make a short call look long. Returns the shorter mean. Work of more than 10 ms is
/// called once.
template <class Clock, class Work>
double seconds_per_call(const Work& work) {
  const double enough = 100e-9 * static_cast<double>(nanoseconds_of_reading<Clock>());
  constexpr std::size_t most = std::size_t{1} << 30U;  // for work that the compiler omits
  constexpr double is_long = 0.01;
  for (std::size_t calls = 1;; calls *= 2) {
    const auto batch = [&] {
      return seconds_of<Clock>([&] {
        for (std::size_t call = 0; call < calls; ++call) work();
      });
    };
    const double seconds = batch();
    if (seconds < enough && calls < most) continue;
    const double again = seconds < is_long ? batch() : seconds;
    if (again >= enough || calls >= most) return std::min(seconds, again) / static_cast<double>(calls);
  }
}

/// The time of a clock, charged to one of several lanes at a time.
template <class Clock>
class StopwatchOf {
 public:
  static constexpr std::size_t stopped = static_cast<std::size_t>(-1);

  void add_lane() { nanoseconds_.push_back(0); }
  /// Charges time to `lane` from now on, or to no lane if `stopped`. Returns the previous lane. The clock is
  /// not read if the lane stays the same.
  std::size_t charge(std::size_t lane) {
    if (lane == lane_) return lane;
    const std::int64_t now = Clock::nanoseconds();
    if (lane_ != stopped) nanoseconds_[lane_] += static_cast<double>(now - since_ - reading_);
    since_ = now;
    const std::size_t before = lane_;
    lane_ = lane;
    return before;
  }
  [[nodiscard]] double seconds(std::size_t lane) const { return 1e-9 * std::max(0.0, nanoseconds_[lane]); }
  void add(std::size_t lane, double seconds) { nanoseconds_[lane] += 1e9 * seconds; }
  void reset() { nanoseconds_.assign(nanoseconds_.size(), 0); }

 private:
  std::int64_t reading_ = nanoseconds_of_reading<Clock>();
  std::vector<double> nanoseconds_{0};
  std::size_t lane_ = stopped;
  std::int64_t since_ = 0;
};

using Stopwatch = StopwatchOf<WallClock>;

}  // namespace kds
