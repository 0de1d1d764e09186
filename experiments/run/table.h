#pragma once
// What a run prints on a terminal.

#include <string>

#include "experiments/run/run_report.h"

namespace kds {

/// One column a structure, one row a figure, the fingerprint last; ends with a newline.
[[nodiscard]] std::string comparison_table(const RunReport& report);

}  // namespace kds
