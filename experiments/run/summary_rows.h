#pragma once
// The comparison of a run's structures, row by row, for the terminal and for the page.

#include <string>
#include <utility>
#include <vector>

#include "experiments/run/run_report.h"

namespace kds {

struct SummaryRow {
  std::string label;
  bool detail = false;             ///< belongs to the row above that is none
  std::vector<std::string> cells;  ///< one a structure; empty: a heading
};

[[nodiscard]] std::vector<SummaryRow> summary_rows(const RunReport& report);

/// A kind of event as it is shown: internal ones, which the total leaves out, say so.
[[nodiscard]] std::string kind_label(const RunReport& report, const std::string& kind);

/// What was run on: label and value.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> input_lines(const RunReport& report);

/// The motion steps of the run, one less than its frames.
[[nodiscard]] std::size_t step_count(const RunReport& report);

}  // namespace kds
