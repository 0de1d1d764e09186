#pragma once
// What `kds update` found, for programs and for people.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/update/compare_updates.h"

namespace kds {

[[nodiscard]] Json update_rows_json(std::span<const UpdateRow> rows);
/// A header and one line a row.
[[nodiscard]] std::string update_csv(std::span<const UpdateRow> rows);
/// A line for each stride, then one for each technique.
[[nodiscard]] std::string update_table(std::span<const UpdateRow> rows);
/// `page` says how it was made.
[[nodiscard]] std::string update_page(std::span<const UpdateRow> rows, const std::string& input, Page page);

}  // namespace kds
