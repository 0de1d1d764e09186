#pragma once
// Reports measured tables, next to the paper's, to programs and people.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/reproduce/paper_tables.h"

namespace kds {

/// Returns an object per row: `table`, `name`, `beads`, `at`, each column under its name and under its name
/// with `_paper` and `_deviation` appended, `note` and `reasons`.
[[nodiscard]] Json paper_rows_json(std::span<const PaperTable> tables);
/// Returns an object per table: `table`, `title` and `findings`. Each finding has the name of the `claim`,
/// whether it `holds`, and `words`, a sentence.
[[nodiscard]] Json paper_findings_json(std::span<const PaperTable> tables);
/// Returns the rows of one table.
[[nodiscard]] std::string paper_csv(const PaperTable& table);
/// Returns the text for the terminal.
[[nodiscard]] std::string paper_text(std::span<const PaperTable> tables);
/// `page` says how the results were made.
[[nodiscard]] std::string paper_page(std::span<const PaperTable> tables, Page page);

}  // namespace kds
