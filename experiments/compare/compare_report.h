#pragma once
// Reports the results of `kds compare` as JSON, as CSV and on the terminal.

#include <string>

#include "experiments/compare/compare_runs.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"

namespace kds {

[[nodiscard]] Json compared_inputs_json(const Comparison& comparison);
/// Returns the columns of compare.json and compare.csv, of the terminal and of the page. Each kind of event
/// has a column; JSON omits the kinds that a structure does not have. Only JSON has the arrays `by_level` and
/// `by_bead`.
[[nodiscard]] Table<CompareRow> compare_columns(const Comparison& comparison);
/// Returns a block for each input and motion, with a line for each stride and structure.
[[nodiscard]] std::string compare_table(const Comparison& comparison);

/// Returns the motion and input of a row if rows differ in them, otherwise an empty text.
[[nodiscard]] std::string distinction(const Comparison& comparison, const CompareRow& row);

// Writes the page of `kds compare` with findings, plots and figures.

/// `page` says how the results were made.
[[nodiscard]] std::string compare_page(const Comparison& comparison, Page page);

}  // namespace kds
