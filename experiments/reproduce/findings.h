#pragma once
// The paper's claims, checked against a table that was measured.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "experiments/reproduce/paper_table.h"

namespace kds {

struct Finding {
  std::string id;     ///< of the claim; tables that tell of the same one share it
  std::string claim;  ///< a sentence without its full stop
  bool holds = false;
  std::string figures;
};

/// The table has all its rows.
[[nodiscard]] std::vector<Finding> findings_of(const PaperTable& table);
/// The claim, yes or no, and the figures.
[[nodiscard]] std::string sentence_of(const Finding& finding);

struct ClaimsJudged {
  std::size_t all = 0, hold = 0;
};
/// Claims that the tables tell of, each once; it holds if it does in all tables that tell of it.
[[nodiscard]] ClaimsJudged judged(std::span<const PaperTable> tables);

}  // namespace kds
