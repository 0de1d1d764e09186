#pragma once
// Checks the paper's claims against a measured table.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "experiments/reproduce/paper_tables.h"

namespace kds {

struct Finding {
  std::string id;     ///< the claim's id; tables about one claim share it
  std::string claim;  ///< a sentence without its full stop
  bool holds = false;
  std::string figures;
};

/// Requires a table with all its rows.
[[nodiscard]] std::vector<Finding> findings_of(const PaperTable& table);
/// Returns the claim, whether it holds, and the figures.
[[nodiscard]] std::string sentence_of(const Finding& finding);

struct ClaimsJudged {
  std::size_t all = 0, hold = 0;
};
/// Counts each claim once. A claim holds if it holds in all tables about it.
[[nodiscard]] ClaimsJudged judged(std::span<const PaperTable> tables);

}  // namespace kds
