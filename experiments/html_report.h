#pragma once
// report.html: one page with the table and the plots, complete in itself.

#include <string>
#include <string_view>

#include "experiments/run_report.h"

namespace kds {

/// Draws the plots with gnuplot; throws std::runtime_error where it fails.
[[nodiscard]] std::string html_report(const RunReport& report);

[[nodiscard]] std::string html_escaped(std::string_view text);

}  // namespace kds
