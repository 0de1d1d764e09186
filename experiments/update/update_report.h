#pragma once
// Reports the results of `kds update` to programs and people.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/update/compare_updates.h"

namespace kds {

/// Returns the columns of update.json and update.csv, of the terminal and of the page.
[[nodiscard]] const Table<UpdateRow>& update_columns();
/// Returns a line for each stride, followed by a line for each technique.
[[nodiscard]] std::string update_table(std::span<const UpdateRow> rows);
/// Completes a page that already says how the results were made.
[[nodiscard]] std::string update_page(std::span<const UpdateRow> rows, const std::string& input, Page page);

}  // namespace kds
