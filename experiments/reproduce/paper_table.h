#pragma once
// A table of the paper, measured again: Agarwal, Guibas, Nguyen, Russel, Zhang, Collision detection for
// deforming necklaces (2004), section 4.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/timing.h"

namespace kds {

struct PaperColumn {
  std::string_view name;   ///< in CSV and JSON
  std::string_view title;  ///< in tables
  bool timed = false;      ///< ratios of times: a spread stands beside them
};

/// A count, or a ratio of two times: the median of the rounds, with the least and the most.
struct PaperValue {
  double value = 0;
  std::optional<Spread> rounds;  ///< of a ratio of times

  PaperValue(double count) : value(count) {}
  PaperValue(const Spread& ratio) : value(ratio.median), rounds(ratio) {}
};

struct PaperRow {
  std::string name;  ///< of the model, as the paper has it
  std::size_t beads = 0;
  std::string at;                            ///< which conformation or step; empty where there is one only
  std::vector<PaperValue> ours;              ///< in the order of the table's columns
  std::vector<std::optional<double>> paper;  ///< likewise; none where the paper has none
  std::string note;                          ///< why the two differ, where they do; may be empty
};

struct PaperTable {
  int number = 1;
  std::string title;
  std::vector<PaperColumn> columns;
  std::vector<PaperRow> rows;
  std::string words;  ///< what differs throughout, and what was found: a few sentences
};

}  // namespace kds
