#pragma once
// Writes the page of `kds compare` with findings, plots and figures.

#include <string>

#include "experiments/compare/compare_runs.h"
#include "experiments/output/page/html_page.h"

namespace kds {

/// `page` says how the results were made.
[[nodiscard]] std::string compare_page(const Comparison& comparison, Page page);

}  // namespace kds
