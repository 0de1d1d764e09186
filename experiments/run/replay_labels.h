#pragma once
// The labels of a replay page: title, command and inputs of its run.

#include <string>

#include "experiments/run/run_options.h"
#include "experiments/view/replay_page.h"

namespace kds {

/// Returns the labels. `command` is the command that writes this page again: run or view.
[[nodiscard]] ReplayLabels replay_labels(const RunOptions& options, const std::string& command);

}  // namespace kds
