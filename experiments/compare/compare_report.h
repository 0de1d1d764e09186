#pragma once
// What `kds compare` found, for programs and on the terminal.

#include <string>
#include <vector>

#include "experiments/compare/compare_runs.h"
#include "experiments/output/result_json.h"

namespace kds {

[[nodiscard]] Json compared_inputs_json(const Comparison& comparison);
/// Each kind of event by name among a row's members; `by_level` and `by_bead` as arrays.
[[nodiscard]] Json compare_rows_json(const Comparison& comparison);
/// A header and one line a row, without what is by level and by bead. Kinds of all structures have columns.
[[nodiscard]] std::string compare_csv(const Comparison& comparison);
/// For each input and motion a line a stride and structure.
[[nodiscard]] std::string compare_table(const Comparison& comparison);

/// What the rows of tables say: structure, stride, steps, events, events a step and a ps, net changes,
/// internal events, efficiency, compactness, locality, microseconds an event, seconds, and events by kind.
[[nodiscard]] std::vector<std::string> compare_cells(const CompareRow& row);

/// The motion and input of a row, as far as rows differ by them; empty where they do not.
[[nodiscard]] std::string distinction(const Comparison& comparison, const CompareRow& row);

}  // namespace kds
