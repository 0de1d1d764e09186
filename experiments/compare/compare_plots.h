#pragma once
// The plots of `kds compare`. If there are more than a few curves, each structure has its own small plot with
// a curve per input and motion.

#include <string>
#include <vector>

#include "experiments/compare/compare_runs.h"

namespace kds {

/// Returns the cases (inputs with their motions) by which rows differ. If all rows have the same input and
/// motion, returns one case with an empty name.
[[nodiscard]] std::vector<std::string> cases_of(const Comparison& comparison);

/// Each function returns one or several HTML figures, or an empty text if there is nothing to show.
[[nodiscard]] std::string plots_over_strides(const Comparison& comparison);
/// Plots the events at the smallest stride by kind.
[[nodiscard]] std::string plots_by_kind(const Comparison& comparison);
[[nodiscard]] std::string plots_by_level(const Comparison& comparison);
/// Plots bars along the chain, and lists the beads that most events name. Inputs with the same chain share a
/// plot.
[[nodiscard]] std::string plots_along_chain(const Comparison& comparison);

}  // namespace kds
