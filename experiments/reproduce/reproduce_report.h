#pragma once
// Measured tables beside the paper's, for programs and for people.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/reproduce/paper_table.h"

namespace kds {

/// A row each: `table`, `name`, `beads`, `at`, each column by name and with `_paper` behind it, `note`.
[[nodiscard]] Json paper_rows_json(std::span<const PaperTable> tables);
/// Of each table `table`, `title`, and `findings`, each with the `claim`'s name, whether it `holds`, and
/// `words`, a sentence.
[[nodiscard]] Json paper_findings_json(std::span<const PaperTable> tables);
/// The same rows of one table.
[[nodiscard]] std::string paper_csv(const PaperTable& table);
/// For the terminal.
[[nodiscard]] std::string paper_text(std::span<const PaperTable> tables);
/// `page` says how it was made.
[[nodiscard]] std::string paper_page(std::span<const PaperTable> tables, Page page);

}  // namespace kds
