#pragma once
// The paper's seven tables: the published values, and how each row is measured here.

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/reproduce/paper_table.h"

namespace kds {

inline constexpr int paper_table_count = 7;

struct PaperTablePlan {
  PaperTable table;                             ///< without rows
  std::vector<std::function<PaperRow()>> rows;  ///< each measures one row
};

/// Plans table `number`, from 1 to 7. Generates its inputs or reads them from the folder `data`. Throws
/// InputError. Times are measured in `rounds` rounds.
[[nodiscard]] PaperTablePlan plan_paper_table(int number, const std::filesystem::path& data,
                                              std::size_t rounds);

}  // namespace kds
