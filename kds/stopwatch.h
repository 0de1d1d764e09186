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
  /// From now on time counts for `lane`, or for none if `stopped`. Returns the lane before. Looking at the
  /// clock takes some 30 ns; where the lane stays nobody does.
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
