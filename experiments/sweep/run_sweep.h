#pragma once
// Runs the tasks of a shard, each in a child process. Results go to a journal in the sweep's folder
// (task_journal.h).

#include <cstddef>

#include "experiments/program/command_line.h"
#include "experiments/sweep/sweep_options.h"
#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/sweep_status.h"
#include "experiments/sweep/task_process.h"

namespace kds {

/// How a shard ended.
struct SweepOutcome {
  SweepCount count;               ///< of the tasks of the shard, in this run or before
  std::size_t without_input = 0;  ///< open tasks with an input that is gone (InputFiles)
  /// Other tasks are open: a signal, the budget or a changed input ended the sweep.
  [[nodiscard]] bool stopped() const { return count.open > without_input; }
};

/// Runs all tasks of the shard that have no result; copies run with the task whose name they have. After a
/// signal or at the end of the budget, running tasks get a few seconds to end, then they are dropped. Throws
/// OutputError if the journal cannot be written, and TryLater if another process runs the shard or if the
/// system has no process for a task. A result that finds no room, or whose files have changed since `files`
/// read them, leaves its task open. `options` must have `out`.
SweepOutcome run_sweep(const SweepPlan& plan, InputFiles& files, const SweepOptions& options,
                       StopSignals& signals);

/// Returns the arguments of a task with those that make the program print JSON only, on one thread unless the
/// sweep says another number.
[[nodiscard]] Arguments task_arguments(const SweepPlan& plan, const SweepTask& task);

}  // namespace kds
