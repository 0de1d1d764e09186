#pragma once
// What `kds update` found, for programs and for people.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/update/compare_updates.h"

namespace kds {

/// The columns of update.json and update.csv, of the terminal and of the page.
[[nodiscard]] const Table<UpdateRow>& update_columns();
/// A line for each stride, then one for each technique.
[[nodiscard]] std::string update_table(std::span<const UpdateRow> rows);
/// Fills a page that made_by began.
[[nodiscard]] std::string update_page(std::span<const UpdateRow> rows, const std::string& input, Page page);

}  // namespace kds
