#pragma once
// The paper's claims, checked against a table that was measured.

#include <string>
#include <vector>

#include "experiments/reproduce/paper_table.h"

namespace kds {

/// A sentence each: the claim, yes or no, and the figures. The table has all its rows.
[[nodiscard]] std::vector<std::string> findings_of(const PaperTable& table);

}  // namespace kds
