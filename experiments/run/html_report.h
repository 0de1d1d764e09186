#pragma once
// report.html: one page with the table and the plots, complete in itself.

#include <string>
#include <vector>

#include "experiments/run/run_report.h"

namespace kds {

/// `data`: names of the files beside it.
[[nodiscard]] std::string html_report(const RunReport& report, const std::vector<std::string>& data = {});

}  // namespace kds
