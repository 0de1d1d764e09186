#pragma once
// Reports the results of `kds theorems` as JSON, CSV, text and a page.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/theorems/plan_theorems.h"

namespace kds {

[[nodiscard]] Json theorem_rows_json(std::span<const TheoremSeries> series);
[[nodiscard]] Json theorem_fits_json(std::span<const TheoremSeries> series);
[[nodiscard]] std::string theorems_csv(std::span<const TheoremSeries> series);
[[nodiscard]] std::string theorems_table(std::span<const TheoremSeries> series);
/// `page` says how the results were made.
[[nodiscard]] std::string theorems_page(std::span<const TheoremSeries> series, Page page);

}  // namespace kds
