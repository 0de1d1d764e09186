#pragma once
// Collects the results of a sweep: tables of all results and of their means, and what is missing.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweep/sweep_plan.h"

namespace kds {

struct CollectedSweep {
  std::size_t tasks = 0, done = 0, failed = 0, crashed = 0, missing = 0;
  std::size_t rows = 0, damaged = 0;
  std::vector<std::string> first_missing;  ///< commands of some tasks without a result
};
/// Writes results.csv, results.json, pooled.csv, times.csv, failed.csv and report.html into the sweep's
/// folder. All but times.csv and report.html hold the same bytes however the sweep ran. The rows are in
/// memory.
CollectedSweep collect_sweep(const SweepPlan& plan, const std::filesystem::path& folder,
                             const std::string& command_line);

}  // namespace kds
