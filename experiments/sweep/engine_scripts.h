#pragma once
// Scripts that run a sweep under Slurm, GNU parallel or Snakemake. A script is written, never started.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace kds {

enum class SweepEngine { slurm, parallel, snakemake };
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> sweep_engine_names{"slurm", "parallel", "snakemake"};
[[nodiscard]] constexpr std::string_view name_of(SweepEngine engine) {
  return sweep_engine_names[static_cast<std::size_t>(engine)];
}

/// Everything that a script depends on.
struct EngineRequest {
  std::filesystem::path program, sweep, folder;   ///< absolute paths
  std::string options;                            ///< further options of kds sweep, quoted
  std::size_t tasks = 0;                          ///< without a result
  std::size_t planned = 0;                        ///< all tasks of the sweep
  std::size_t jobs = 1;                           ///< tasks at a time, and processor cores, of a batch
  std::optional<std::uint64_t> task_memory = {};  ///< --task-memory, in bytes
  double hours = 0;                               ///< expected for all tasks on one core
  double longest = 0;                             ///< expected seconds of the longest task
};

/// How tasks are divided: at most 1,000 batches, of about 15 minutes each if that many suffice.
struct Batches {
  std::size_t count = 1;
  double seconds = 0;              ///< expected for one batch
  std::size_t limit_minutes = 0;   ///< time limit of a batch
  std::size_t budget_seconds = 0;  ///< --time-budget of a batch, a little less
};
[[nodiscard]] Batches batches_of(const EngineRequest& request);

/// Returns the bytes of memory that a batch asks its engine for, or nothing without --task-memory: the memory
/// of `jobs` tasks, and for the sweep itself 128 MiB and 1 KiB for each planned task. A sweep of a million
/// tasks takes half as much (docs/cluster.md).
[[nodiscard]] std::optional<std::uint64_t> batch_memory(const EngineRequest& request);

/// Returns a number of batches with its noun, as in "1 batch" or "1,000 batches".
[[nodiscard]] std::string batches_text(std::size_t count);
/// Returns the name of the script in the sweep's folder.
[[nodiscard]] std::string script_name(SweepEngine engine);
/// Returns the command that starts the script.
[[nodiscard]] std::string start_command(SweepEngine engine, const EngineRequest& request);
[[nodiscard]] std::string engine_script(SweepEngine engine, const EngineRequest& request);

}  // namespace kds
