#pragma once
// What `kds missed` found, for programs and for people.

#include <span>
#include <string>

#include "experiments/collide/missed_contacts.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"

namespace kds {

[[nodiscard]] Json missed_rows_json(std::span<const MissedRow> rows);
/// A header and one line a row.
[[nodiscard]] std::string missed_csv(std::span<const MissedRow> rows);
[[nodiscard]] std::string missed_table(std::span<const MissedRow> rows);
/// `page` says how it was made.
[[nodiscard]] std::string missed_page(std::span<const MissedRow> rows, const std::string& input, Page page);

}  // namespace kds
