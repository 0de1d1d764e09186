#pragma once
// Reports the results of `kds missed`.

#include <span>
#include <string>

#include "experiments/collide/missed_contacts.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"

namespace kds {

/// Returns the columns of missed.json and missed.csv, of the terminal and of the page.
[[nodiscard]] const Table<MissedRow>& missed_columns();
/// `page` says how the results were made.
[[nodiscard]] std::string missed_page(std::span<const MissedRow> rows, const std::string& input, Page page);

}  // namespace kds
