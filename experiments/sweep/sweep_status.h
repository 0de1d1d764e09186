#pragma once
// The states of a sweep's tasks: counts for `kds sweep status`, tasks without a result, and warnings.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/task_journal.h"

namespace kds {

/// The states of the tasks of one command. Tasks that run are open.
struct SweepCount {
  std::string command;
  std::size_t tasks = 0, done = 0, warned = 0, failed = 0, crashed = 0, open = 0;
  double seconds = 0;  ///< of the tasks that are done
  /// Expected for the open tasks, from the mean of those of the same command that are done. Nothing if none
  /// of a command is done.
  std::optional<double> hours_left = 0;
};

/// Adds a task. `running` says that a sweep is at work: a task that it has begun is open, not crashed.
void count_task(const TaskState& state, bool running, SweepCount& count);
/// Counts the tasks by command, in the order of sweep.json. The last count is that of all tasks.
[[nodiscard]] std::vector<SweepCount> count_tasks(const SweepPlan& plan, const TaskStates& states,
                                                  bool running);
/// Returns a table, without the sum over all commands if there is only one.
[[nodiscard]] std::string counts_text(const std::vector<SweepCount>& counts);
/// Returns a line for each other version of kds that has results in the folder.
[[nodiscard]] std::string other_versions_text(const TaskStates& states);

/// A message of a task: why it failed or crashed, or a warning.
struct TaskMessage {
  std::string task, command, input, status, message, repeat;
  std::uint64_t code = 0;
};
/// Returns why a task failed or crashed, or nothing if it did not.
[[nodiscard]] std::optional<TaskMessage> failure_of(const SweepPlan& plan, const SweepTask& task,
                                                    const TaskStates& states);
/// Returns a row of the task's names.
[[nodiscard]] TaskMessage message_of(const SweepPlan& plan, const SweepTask& task, std::string message);
/// Returns the table of failed.csv, or that of warnings.csv.
[[nodiscard]] Table<TaskMessage> message_table(bool of_failures);

}  // namespace kds
