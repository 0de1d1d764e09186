#pragma once
// The plots of `kds compare`. With more than a few curves each structure has a small plot of its own, in
// which the curves are the inputs and motions.

#include <string>
#include <vector>

#include "experiments/compare/compare_runs.h"

namespace kds {

/// Inputs with their motions, as rows are told apart by them; one without a name where all rows share them.
[[nodiscard]] std::vector<std::string> cases_of(const Comparison& comparison);

/// Each an HTML figure or several; empty where there is nothing to show.
[[nodiscard]] std::string plots_over_strides(const Comparison& comparison);
/// Of the smallest stride.
[[nodiscard]] std::string plots_by_kind(const Comparison& comparison);
[[nodiscard]] std::string plots_by_level(const Comparison& comparison);
/// For inputs of the same chain together: bars along it, and the beads that most events name.
[[nodiscard]] std::string plots_along_chain(const Comparison& comparison);

}  // namespace kds
