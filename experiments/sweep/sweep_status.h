#pragma once
// The states of a sweep's tasks: counts for `kds sweep status`, and the tasks that have no result.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/output/page/table.h"
#include "experiments/sweep/run_sweep.h"
#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/task_journal.h"

namespace kds {

/// The states of the tasks of one command.
struct SweepCount {
  std::string command;
  std::size_t tasks = 0, done = 0, failed = 0, crashed = 0, running = 0, open = 0;
  double seconds = 0;  ///< of the tasks that are done
  /// Expected for the tasks that run or are open, from the mean of those of the same command that are done.
  /// Nothing if none of a command is done.
  std::optional<double> hours_left = {};
};
/// Counts the tasks by command, in the order of sweep.json. The last count is that of all tasks.
[[nodiscard]] std::vector<SweepCount> count_tasks(const SweepPlan& plan, const std::filesystem::path& folder);
/// Returns these counts from states that have been read.
[[nodiscard]] std::vector<SweepCount> counts_from(const SweepPlan& plan, const TaskStates& states,
                                                  const std::filesystem::path& folder);
[[nodiscard]] Table<SweepCount> count_table();
/// Leaves out the sum over all commands if there is only one.
[[nodiscard]] std::span<const SweepCount> without_repeated_sum(const std::vector<SweepCount>& counts);
[[nodiscard]] std::string status_text(const std::vector<SweepCount>& counts);

/// A task that failed or crashed: its message, and the command that repeats it.
struct FailedTask {
  std::string task, command, input, status, error, repeat;
  std::uint64_t code = 0;
};
[[nodiscard]] std::vector<FailedTask> failed_tasks(const SweepPlan& plan, const TaskStates& states);
[[nodiscard]] Table<FailedTask> failed_table();
/// Writes failed.csv, with a line for each such task. Returns the number of lines.
std::size_t write_failed(const SweepPlan& plan, const std::filesystem::path& folder);

}  // namespace kds
