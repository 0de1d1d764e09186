#pragma once
// Collects the results of a sweep: tables of all results and of their means, warnings, and what is missing.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/sweep_status.h"

namespace kds {

struct CollectedSweep {
  SweepCount all;
  std::size_t rows = 0;
  std::vector<std::string> first_missing;  ///< commands of some tasks without a result
};
/// Writes results.csv, results.json, pooled.csv, times.csv, failed.csv, warnings.csv and report.html into the
/// sweep's folder. All but times.csv and report.html hold the same bytes however the sweep ran. Each result
/// is read twice, and one result is in memory at a time. Throws InputError if tasks are missing and the
/// folder's results.json is of more tasks.
CollectedSweep collect_sweep(const SweepPlan& plan, const TaskStates& states,
                             const std::filesystem::path& folder, const std::string& command_line);
/// Writes failed.csv.
void write_failed(const SweepPlan& plan, const TaskStates& states, const std::filesystem::path& folder);

}  // namespace kds
