#pragma once
// report.html: one page with the table and the plots, complete in itself.

#include <string>

#include "experiments/run/run_report.h"

namespace kds {

/// Draws the plots with gnuplot; throws std::runtime_error where it fails.
[[nodiscard]] std::string html_report(const RunReport& report);

}  // namespace kds
