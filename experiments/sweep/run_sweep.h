#pragma once
// Runs the tasks of a sweep, each in a child process. Results go to the journals of the sweep's folder
// (task_journal.h). Several sweeps may run on one folder, on one machine or several.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/task_journal.h"
#include "experiments/sweep/task_launcher.h"
#include "experiments/sweep/task_process.h"

namespace kds {

/// Shard `number` of `count`, counted from 1: tasks number - 1, number - 1 + count, ... of the plan.
struct Shard {
  std::size_t number = 1, count = 1;
};

struct SweepLimits {
  Shard shard;
  std::size_t jobs = 1;                      ///< child processes at a time
  std::optional<double> task_seconds;        ///< longest time of a task
  std::optional<std::uint64_t> task_memory;  ///< bytes of data of a task
  TaskProcess::Clock::time_point begin = TaskProcess::Clock::now();
  std::optional<double> budget;  ///< seconds after `begin` at which the sweep has ended
  bool retry = false;            ///< repeat tasks that failed or crashed
};

/// The states of a task in the journals. A task that two attempts have left without a result is crashed.
enum class TaskStatus : std::uint8_t { open, done, failed, crashed };
[[nodiscard]] TaskStatus status_of(const TaskState& state);

struct SweepOutcome {
  std::size_t tasks = 0;                          ///< of the shard
  std::size_t done = 0, failed = 0, crashed = 0;  ///< tasks of the shard, in this run or before
  std::size_t ran = 0;                            ///< attempts of this run that ended
  std::size_t dropped = 0;
  std::size_t without_input = 0;  ///< tasks without a result, with an input that is gone (InputHashes)
  bool stopped = false;  ///< other tasks are open: a signal, the budget or a changed input ended the sweep
};

/// The folder of journals and the file of locks, in the folder of a sweep.
[[nodiscard]] std::filesystem::path results_folder(const std::filesystem::path& sweep);
[[nodiscard]] std::filesystem::path locks_file(const std::filesystem::path& sweep);

/// Runs all tasks of the shard that have no result. Waits for tasks that another sweep is running. After a
/// signal or at the end of the budget, running tasks get a few seconds to end, then they are dropped. Throws
/// OutputError if the journal cannot be written. A result that finds no room leaves its task open, and so
/// does a result whose files have changed since `hashes` read them.
SweepOutcome run_sweep(const SweepPlan& plan, InputHashes& hashes, const std::filesystem::path& folder,
                       const SweepLimits& limits, TaskLauncher& launcher, StopSignals& signals,
                       const std::function<void(std::size_t done, std::size_t total)>& progress,
                       const std::function<void(const std::string&)>& warn);

}  // namespace kds
