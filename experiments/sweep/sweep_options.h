#pragma once
// The options of `kds sweep`, and the share and the number of tasks that follow from them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "experiments/program/option.h"
#include "experiments/sweep/engine_scripts.h"
#include "experiments/sweep/run_sweep.h"

namespace kds {

struct SweepOptions {
  std::optional<std::filesystem::path> out;
  bool dry_run = false, retry = false, quiet = false;
  std::optional<Shard> shard;
  std::optional<std::size_t> jobs;
  std::optional<double> task_seconds, time_budget;
  std::optional<std::uint64_t> task_memory;  ///< bytes
  std::optional<SweepEngine> write;
};

[[nodiscard]] const OptionList<SweepOptions>& sweep_options();

/// Throws InputError if an option of a run stands beside --dry-run or --write, which run no sweep.
void refuse_conflicts(const ParsedArguments& parsed);
/// Returns the shard that --shard says, or that of this element of a Slurm array. Throws InputError.
[[nodiscard]] Shard shard_of(const SweepOptions& options);
/// Returns the number of tasks to run at a time. Throws InputError.
[[nodiscard]] std::size_t jobs_of(const SweepOptions& options);

}  // namespace kds
