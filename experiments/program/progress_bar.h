#pragma once
// Prints on standard error: the progress of a run if it is a terminal, and warnings.

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kds {

/// Returns "[####............] step 12 of 48, 3 s, about 9 s left". `counted` names the unit that is counted.
/// `within` is the completed share of the current unit.
[[nodiscard]] std::string progress_line(std::string_view counted, std::size_t done, double within,
                                        std::size_t total, double seconds);

class ProgressBar {
 public:
  /// Returns a text that describes the run at this moment.
  using State = std::function<std::string()>;

  /// `counted` names the unit that is counted, as in "step 12 of 48".
  explicit ProgressBar(bool wanted, std::string_view counted, std::FILE* stream = stderr);
  ~ProgressBar() { erase(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar, at most ten times a second.
  void update(std::size_t done, std::size_t total) { update(done, 0, total); }
  /// Draws the bar. `within` is the completed share of the current unit.
  void update(std::size_t done, double within, std::size_t total);
  /// Sets what the line says of a run whose total is 0, for unknown: "step 1,234, STATE, 12 s". `state` is
  /// called by `update`. Without it, such a run has no line.
  void describe(State state) { state_ = std::move(state); }
  void erase();  ///< call it before anything else is printed

 private:
  using Clock = std::chrono::steady_clock;
  std::FILE* stream_;  ///< null for no output
  std::string counted_;
  State state_;
  Clock::time_point start_ = Clock::now(), drawn_ = start_;
  bool visible_ = false;
};

/// Print a warning or a note as one line on standard error. The progress bar is erased first.
void print_warning(ProgressBar& bar, const std::string& warning);
void print_note(ProgressBar& bar, const std::string& note);

/// Holds warnings about an input that may still be refused. If the input is refused, only the error is
/// printed.
class HeldWarnings {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Returns a function that holds a warning. The function must not be called after this object is destroyed.
  [[nodiscard]] Warn hold() {
    return [this](const std::string& warning) { held_.push_back(warning); };
  }
  /// Passes on all held warnings in order.
  void release(const Warn& warn) {
    for (const std::string& warning : held_) warn(warning);
    held_.clear();
  }

 private:
  std::vector<std::string> held_;
};

}  // namespace kds
