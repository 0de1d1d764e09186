#pragma once
// The options of `kds sweep`.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "experiments/program/option.h"
#include "experiments/sweep/engine_scripts.h"
#include "experiments/sweep/sweep_folder.h"

namespace kds {

struct SweepOptions {
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::optional<std::filesystem::path> out;
  bool dry_run = false, retry = false, quiet = false;
  Shard shard;
  std::optional<std::size_t> jobs, batches;
  std::optional<double> task_seconds, time_budget;
  std::optional<std::uint64_t> task_memory;  ///< bytes
  std::optional<SweepEngine> write;
};

[[nodiscard]] const OptionList<SweepOptions>& sweep_options();

/// Throws InputError if an option of a run stands beside --dry-run or --write, which run no sweep, or if an
/// option of scripts stands without --write.
void refuse_conflicts(const ParsedArguments& parsed);

}  // namespace kds
