#pragma once
// Writes report.html: one self-contained page with the table and the plots.

#include <string>
#include <vector>

#include "experiments/run/run_report.h"

namespace kds {

/// `data` has the names of the files that lie beside the page.
[[nodiscard]] std::string html_report(const RunReport& report, const std::vector<std::string>& data = {});

}  // namespace kds
