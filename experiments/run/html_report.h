#pragma once
// The page report.html of a run, with the rows that compare the structures on the page and on the terminal.

#include <filesystem>
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

/// Returns the number of motion steps, which is one less than the number of frames.
[[nodiscard]] std::size_t step_count(const RunReport& report);

/// `data` has the names of the files that lie next to the page, and `replay` is as in Page.
[[nodiscard]] std::string html_report(const RunReport& report, const std::vector<std::string>& data = {},
                                      const std::filesystem::path& replay = {});

}  // namespace kds
