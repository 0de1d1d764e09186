#pragma once
// The text that a run prints on a terminal.

#include <string>

#include "experiments/run/run_report.h"

namespace kds {

/// Returns a table with one column per structure and one row per figure. The fingerprint comes last. The text
/// ends with a newline.
[[nodiscard]] std::string comparison_table(const RunReport& report);

}  // namespace kds
