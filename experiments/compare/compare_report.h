#pragma once
// Reports the results of `kds compare` as JSON, as CSV, on the terminal, and as a page with findings, plots
// and figures.

#include <string>
#include <vector>

#include "experiments/compare/compare_runs.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"

namespace kds {

[[nodiscard]] Json compared_inputs_json(const Comparison& comparison);
/// Returns the columns of compare.json and compare.csv, and those of the terminal, which are fewer. Each kind
/// of event has a column; JSON omits the kinds that a structure does not have. Only JSON has the arrays
/// `by_level` and `by_bead`.
[[nodiscard]] Table<CompareRow> compare_columns(const Comparison& comparison);
[[nodiscard]] Table<PooledRow> pooled_columns();
/// Returns a block for each input and motion, with a line for each stride and structure.
[[nodiscard]] std::string compare_table(const Comparison& comparison);

/// Returns the input of a row.
[[nodiscard]] const ComparedInput& input_of(const Comparison& comparison, const CompareRow& row);
/// Returns the motion and input of a row if rows differ in them, otherwise an empty text.
[[nodiscard]] std::string distinction(const Comparison& comparison, const CompareRow& row);

/// `page` says how the results were made.
[[nodiscard]] std::string compare_page(const Comparison& comparison, Page page);

// The plots of `kds compare`. If there are more than a few curves, each structure has its own small plot with
// a curve per input and motion.

/// Returns the cases (inputs with their motions) by which rows differ. If all rows have the same input and
/// motion, returns one case with an empty name.
[[nodiscard]] std::vector<std::string> cases_of(const Comparison& comparison);

/// Each function returns one or several HTML figures, or an empty text if there is nothing to show.
[[nodiscard]] std::string plots_over_strides(const Comparison& comparison);
/// Plots the events per step at the smallest stride, in bins of neighbouring steps.
[[nodiscard]] std::string plots_over_time(const Comparison& comparison);
/// Plots the events at the smallest stride by kind.
[[nodiscard]] std::string plots_by_kind(const Comparison& comparison);
[[nodiscard]] std::string plots_by_level(const Comparison& comparison);
/// Plots bars along the chain, and lists the beads that most events name. Inputs with the same chain share a
/// plot.
[[nodiscard]] std::string plots_along_chain(const Comparison& comparison);

}  // namespace kds
