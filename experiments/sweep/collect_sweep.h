#pragma once
// Collects the results of a sweep: tables of all results and of their means, and what is missing.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweep/run_sweep.h"
#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/task_journal.h"

namespace kds {

/// The states of the tasks of one command, for `kds sweep status`.
struct SweepCount {
  std::string command;
  std::size_t tasks = 0, done = 0, failed = 0, crashed = 0, running = 0, open = 0;
  double seconds = 0;  ///< of the tasks that are done
};
/// Counts the tasks by command, in the order of sweep.json. The last count is that of all tasks.
[[nodiscard]] std::vector<SweepCount> count_tasks(const SweepPlan& plan, const std::filesystem::path& folder);
[[nodiscard]] std::string status_text(const std::vector<SweepCount>& counts);

/// Writes failed.csv: a line for each task that failed or crashed, with its message and the command that
/// repeats it. Returns the number of lines.
std::size_t write_failed(const SweepPlan& plan, const std::filesystem::path& folder);

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
