#pragma once
// Runs all requested subjects in all requested extremes.

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/stability/stability_options.h"

namespace kds {

/// `progress` gets the number of rows done and of all rows. Throws InputError if no extreme applies to any
/// subject.
[[nodiscard]] std::vector<StabilityRow> run_stability(
    const StabilityOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
