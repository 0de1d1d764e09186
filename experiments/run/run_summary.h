#pragma once
// The rows of the terminal that compare the structures of a run.

#include <string>
#include <utility>
#include <vector>

#include "experiments/run/run_report.h"

namespace kds {

struct SummaryRow {
  std::string label;
  bool detail = false;             ///< details the nearest row above that is not a detail
  std::vector<std::string> cells;  ///< one per structure; empty for a heading
};

[[nodiscard]] std::vector<SummaryRow> summary_rows(const RunReport& report);

/// Returns the lines that describe the input, as pairs of label and value.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> input_lines(const RunReport& report);

}  // namespace kds
