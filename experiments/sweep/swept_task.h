#pragma once
// One task of a sweep: its arguments, the messages with which it ends, and a trial that estimates how long
// other tasks take.

#include <string>
#include <string_view>

#include "experiments/program/command_line.h"
#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/task_process.h"

namespace kds {

/// Returns the arguments of a task with those that make the program print JSON only, on one thread.
[[nodiscard]] Arguments task_arguments(const SweepPlan& plan, const SweepTask& task);
/// Returns whether the sweep sets the number of threads of this task.
[[nodiscard]] bool sets_threads(const SweepPlan& plan, const SweepTask& task);

/// Returns JSON on one line. A line break of indented JSON is never inside a string.
[[nodiscard]] std::string joined_lines(std::string_view json);
/// Returns the last message that a command wrote to standard error, without the program's name. Warnings are
/// no messages.
[[nodiscard]] std::string message_of(const std::string& err);
/// Returns a signal's number and name, as in "signal 9 (Killed)".
[[nodiscard]] std::string signal_text(int signal);
/// Returns the JSON of a record of a failed task.
[[nodiscard]] std::string failure_json(int code, const std::string& message, double seconds);

/// The times of one task that was run to estimate others. `error` is its message if it failed.
struct TrialRun {
  double seconds = 0;
  bool cut_off = false;  ///< ended at the limit
  std::string error;
};
/// Runs a task without recording it. Throws SweepStopped.
[[nodiscard]] TrialRun try_task(const SweepPlan& plan, const SweepTask& task, double most_seconds,
                                StopSignals& signals);

}  // namespace kds
