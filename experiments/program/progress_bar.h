#pragma once
// A line on a terminal that says how far the run is and how long the rest may take; nothing where the stream
// is no terminal.

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace kds {

/// "[####............] step 12 of 48, 3 s, about 9 s left". `counted` names what is counted, `within` is the
/// part of the next one that is done.
[[nodiscard]] std::string progress_line(std::string_view counted, std::size_t done, double within,
                                        std::size_t total, double seconds);

class ProgressBar {
 public:
  /// `counted` names what is counted, as in "step 12 of 48".
  explicit ProgressBar(bool wanted, std::string_view counted, std::FILE* stream = stderr);
  ~ProgressBar() { erase(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws at most ten times a second.
  void update(std::size_t done, std::size_t total) { update(done, 0, total); }
  /// `within` is the share of the next one that is done.
  void update(std::size_t done, double within, std::size_t total);
  void erase();  ///< before anything else is printed

 private:
  using Clock = std::chrono::steady_clock;
  std::FILE* stream_;  ///< null: stay silent
  std::string counted_;
  Clock::time_point start_ = Clock::now(), drawn_ = start_;
  bool visible_ = false;
};

}  // namespace kds
