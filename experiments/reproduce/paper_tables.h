#pragma once
// The seven tables of the paper, measured again: Agarwal, Guibas, Nguyen, Russel, Zhang, Collision detection
// for deforming necklaces (2004), section 4.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/timing.h"

namespace kds {

struct PaperColumn {
  std::string_view name;   ///< in CSV and JSON
  std::string_view title;  ///< in tables
  bool timed = false;      ///< ratios of times, which are shown with their spread
};

/// A count, or a ratio of two times: the median of the rounds with the least and the most.
struct PaperValue {
  double value = 0;
  std::optional<Spread> rounds;  ///< for a ratio of times

  PaperValue(double count) : value(count) {}
  PaperValue(const Spread& ratio) : value(ratio.median), rounds(ratio) {}
};

struct PaperRow {
  std::string name;  ///< the model's name, as in the paper
  std::size_t beads = 0;
  std::string at;                            ///< conformation or step; empty if there is only one
  std::vector<PaperValue> ours;              ///< in the order of the table's columns
  std::vector<std::optional<double>> paper;  ///< in the same order; empty where the paper has no value
  std::string note;                          ///< why our values and the paper's differ; may be empty
};

struct PaperTable {
  int number = 1;
  std::string title;
  std::vector<PaperColumn> columns;
  std::vector<PaperRow> rows;
  std::string words;  ///< a few sentences: general differences, and the findings
};

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
