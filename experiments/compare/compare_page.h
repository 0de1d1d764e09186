#pragma once
// The page of `kds compare`: what was found, plots, and the figures.

#include <string>

#include "experiments/compare/compare_runs.h"

namespace kds {

/// Plots are drawn by gnuplot.
[[nodiscard]] std::string compare_page(const Comparison& comparison, const std::string& command_line);

}  // namespace kds
