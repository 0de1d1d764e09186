#pragma once
// The seven tables of the paper, measured again: Agarwal, Guibas, Nguyen, Russel, Zhang, Collision detection
// for deforming necklaces (2004), section 4.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/program/timing.h"

namespace kds {

/// The kind of the values of a column.
enum class Quantity : std::uint8_t {
  time,   ///< in the unit that its title names; machines differ, so it has no deviation
  ratio,  ///< of two times of the row
  number  ///< a count, or a ratio of lengths or counts
};

struct PaperColumn {
  std::string_view name;   ///< in CSV and JSON
  std::string_view title;  ///< in tables
  Quantity quantity = Quantity::number;
  bool in_paper = true;          ///< whether the paper has such a column
  std::string_view reason = {};  ///< why rows without a reason of their own deviate
};

/// A number, or a time or ratio of times: the median of the rounds with the least and the most.
struct PaperValue {
  double value = 0;
  std::optional<Spread> rounds;  ///< of a time or ratio of times

  PaperValue(double number) : value(number) {}
  PaperValue(const Spread& times) : value(times.median), rounds(times) {}
};

/// Names of columns, and why a row deviates there.
using Reasons = std::vector<std::pair<std::string_view, std::string>>;

struct PaperRow {
  std::string name;  ///< of the model, as in the paper, with the stand-in's name
  std::size_t beads = 0;
  std::string at;                            ///< conformation or step; empty if there is only one
  std::vector<PaperValue> ours;              ///< in the order of the table's columns
  std::vector<std::optional<double>> paper;  ///< in the same order; empty where the paper has no value
  std::string note;                          ///< how the input differs from the paper's; may be empty
  Reasons reasons;                           ///< for columns that may deviate by more than explained_from
};

struct PaperTable {
  int number = 1;
  std::string title;
  std::vector<PaperColumn> columns;
  std::vector<PaperRow> rows;
  std::string words;  ///< a few sentences: how the table is measured
};

/// A deviation above this needs a reason.
inline constexpr double explained_from = 0.25;

/// Returns ours / paper - 1. Returns nothing for times, for columns that the paper lacks, and for rows
/// without the paper's value or where that value is 0.
[[nodiscard]] std::optional<double> deviation_of(const PaperTable& table, const PaperRow& row,
                                                 std::size_t column);

struct Deviation {
  std::size_t column = 0;
  std::optional<double> share;  ///< ours / paper - 1; nothing if the paper's value is 0
  std::string reason;           ///< of the row, else of the column, else "no reason is known"
};
/// Returns the deviations above explained_from, and those from a paper's value of 0.
[[nodiscard]] std::vector<Deviation> large_deviations(const PaperTable& table, const PaperRow& row);

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
