#pragma once
// A line on a terminal that says how far the run is; nothing where the stream is no terminal.

#include <chrono>
#include <cstddef>
#include <cstdio>

namespace kds {

class ProgressBar {
 public:
  explicit ProgressBar(bool wanted, std::FILE* stream = stderr);
  ~ProgressBar() { erase(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(std::size_t done, std::size_t total);  ///< draws at most ten times a second
  void erase();                                      ///< before anything else is printed

 private:
  using Clock = std::chrono::steady_clock;
  std::FILE* stream_;  ///< null: stay silent
  Clock::time_point start_ = Clock::now(), drawn_ = start_;
  bool visible_ = false;
};

}  // namespace kds
