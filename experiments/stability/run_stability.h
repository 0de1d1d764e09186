#pragma once
// All subjects in all extremes that were asked for.

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/stability/stability_options.h"

namespace kds {

/// `progress`: rows done, rows in all. Throws InputError if no extreme applies to any subject.
[[nodiscard]] std::vector<StabilityRow> run_stability(
    const StabilityOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
