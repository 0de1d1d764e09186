#pragma once
// Estimates how long a sweep takes, from one task of each command.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/sweep/sweep_plan.h"
#include "experiments/sweep/task_process.h"

namespace kds {

/// The expected work of one command, from one task of it.
struct SweepEstimate {
  std::string command;
  std::size_t tasks = 0, open = 0;  ///< all tasks, and those without a result
  double seconds = 0;               ///< of the task that was run
  double hours = 0, longest = 0;    ///< expected for all open tasks; seconds of the longest
  bool cut_off = false;             ///< the task was ended after a minute
  std::string error;                ///< why the task failed; empty if it did not
};

/// Runs the open task of median size of each command, at most a minute and at most `task_seconds`. All others
/// are taken to need time in proportion to their size. `folder` has the results of the sweep, if it has any.
/// With `retry`, tasks that failed or crashed count as open. Throws SweepStopped.
[[nodiscard]] std::vector<SweepEstimate> estimate_sweep(const SweepPlan& plan, const InputHashes& hashes,
                                                        const std::optional<std::filesystem::path>& folder,
                                                        bool retry, std::optional<double> task_seconds,
                                                        StopSignals& signals);
[[nodiscard]] double sum_of_hours(const std::vector<SweepEstimate>& estimates);
/// Returns a table and a line with the hours for `jobs` tasks at a time.
[[nodiscard]] std::string estimates_text(const SweepPlan& plan, const std::vector<SweepEstimate>& estimates,
                                         std::size_t jobs);

}  // namespace kds
