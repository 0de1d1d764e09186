#pragma once
// The paper's seven tables: what it says, and how each row is measured here.

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/reproduce/paper_table.h"

namespace kds {

inline constexpr int paper_table_count = 7;

struct PaperTablePlan {
  PaperTable table;                             ///< without rows
  std::vector<std::function<PaperRow()>> rows;  ///< each measures one
};

/// Table 1 to 7. Its inputs are made, or read from the folder `data`: throws InputError. Times are
/// measured in so many rounds.
[[nodiscard]] PaperTablePlan plan_paper_table(int number, const std::filesystem::path& data,
                                              std::size_t rounds);

}  // namespace kds
