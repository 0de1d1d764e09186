#pragma once
// The page of `kds stability`. It says whether the kernels agree, and where the arithmetic was hardest.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/stability/stability_row.h"

namespace kds {

/// `page` says how the results were made.
[[nodiscard]] std::string stability_page(std::span<const StabilityRow> rows, Page page);

}  // namespace kds
