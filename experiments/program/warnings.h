#pragma once
// Warnings share standard error with the progress bar, and wait until no error can come from the input.

#include <functional>
#include <string>
#include <vector>

#include "experiments/program/progress_bar.h"

namespace kds {

/// One line; the bar makes room for it.
void print_warning(ProgressBar& bar, const std::string& warning);

/// Warnings about an input that may yet be refused: an error comes alone.
class HeldWarnings {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Takes a warning and keeps it; to be used while this lives.
  [[nodiscard]] Warn hold() {
    return [this](const std::string& warning) { held_.push_back(warning); };
  }
  /// Passes on all that were held, in order.
  void release(const Warn& warn) {
    for (const std::string& warning : held_) warn(warning);
    held_.clear();
  }

 private:
  std::vector<std::string> held_;
};

}  // namespace kds
