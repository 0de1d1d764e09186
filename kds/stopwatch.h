#pragma once
// Wall time, charged to one of several lanes at a time.

#include <chrono>
#include <cstddef>
#include <vector>

namespace kds {

class Stopwatch {
 public:
  static constexpr std::size_t stopped = static_cast<std::size_t>(-1);

  void add_lane() { seconds_.push_back(0); }
  /// Charges time to `lane` from now on, or to no lane if `stopped`. Returns the previous lane. Reading the
  /// clock takes about 30 ns; it is not read if the lane stays the same.
  std::size_t charge(std::size_t lane) {
    if (lane == lane_) return lane;
    const auto now = std::chrono::steady_clock::now();
    if (lane_ != stopped) seconds_[lane_] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    const std::size_t before = lane_;
    lane_ = lane;
    return before;
  }
  [[nodiscard]] double seconds(std::size_t lane) const { return seconds_[lane]; }
  void reset() { seconds_.assign(seconds_.size(), 0); }

 private:
  std::vector<double> seconds_{0};
  std::size_t lane_ = stopped;
  std::chrono::steady_clock::time_point since_{};
};

}  // namespace kds
