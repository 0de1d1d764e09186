#pragma once
// Prints warnings, which share standard error with the progress bar. Warnings about the input are held back
// until the input can no longer be refused.

#include <functional>
#include <string>
#include <vector>

#include "experiments/program/progress_bar.h"

namespace kds {

/// Prints one line. The progress bar is erased first.
void print_warning(ProgressBar& bar, const std::string& warning);

/// Holds warnings about an input that may still be refused. If the input is refused, only the error is
/// printed.
class HeldWarnings {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Returns a function that holds a warning. It must not be called after this object is destroyed.
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
