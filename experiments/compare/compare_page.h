#pragma once
// The page of `kds compare`: what was found, plots, and the figures.

#include <string>

#include "experiments/compare/compare_runs.h"
#include "experiments/output/page/html_page.h"

namespace kds {

/// `page` says how it was made.
[[nodiscard]] std::string compare_page(const Comparison& comparison, Page page);

}  // namespace kds
