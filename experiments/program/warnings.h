#pragma once
// Warnings share standard error with the progress bar.

#include <string>

#include "experiments/program/progress_bar.h"

namespace kds {

/// One line; the bar makes room for it.
void print_warning(ProgressBar& bar, const std::string& warning);

}  // namespace kds
