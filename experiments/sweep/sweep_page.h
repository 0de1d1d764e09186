#pragma once
// The report of a sweep: plots and tables of means, and the tasks that have no result.

#include <string>
#include <vector>

#include "experiments/sweep/collect_sweep.h"
#include "experiments/sweep/pooled_figures.h"
#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/sweep_status.h"

namespace kds {

/// Returns a page that stands alone. `command_line` repeats it.
[[nodiscard]] std::string sweep_page(const SweepPlan& plan, const CollectedSweep& collected,
                                     const PooledFigures& pool, const std::vector<FailedTask>& failed,
                                     const std::vector<SweepCount>& counts, const std::string& command_line);

}  // namespace kds
