#pragma once
// Reports the results of `kds compare` as JSON, as CSV and on the terminal.

#include <string>
#include <vector>

#include "experiments/compare/compare_runs.h"
#include "experiments/output/result_json.h"
#include "experiments/output/table.h"

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
}  // namespace kds
