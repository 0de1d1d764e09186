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

/// Everything that a script depends on. A batch is a shard: `batches` of them run all tasks.
struct EngineRequest {
  SweepEngine engine = SweepEngine::slurm;
  std::filesystem::path program, sweep, folder;   ///< absolute paths
  std::string options;                            ///< further options of kds sweep, each after a blank
  std::size_t batches = 1, tasks = 0;             ///< tasks of the whole sweep
  std::size_t jobs = 1;                           ///< tasks at a time, and processor cores, of a batch
  std::size_t seconds = 3600;                     ///< --time-budget of a batch of Slurm
  std::optional<std::uint64_t> task_memory = {};  ///< --task-memory, in bytes
};

/// Returns the bytes of memory that a batch asks its engine for, or nothing without --task-memory: the memory
/// of `jobs` tasks, and for the sweep itself 128 MiB and 1 KiB for each task.
[[nodiscard]] std::optional<std::uint64_t> batch_memory(const EngineRequest& request);

/// Returns the name of the script in the sweep's folder.
[[nodiscard]] std::string script_name(SweepEngine engine);
/// Returns the command that starts the script.
[[nodiscard]] std::string start_command(const EngineRequest& request);
/// Throws InputError if a path has a character that an engine interprets: a control character, or one
/// of \ " % { }.
[[nodiscard]] std::string engine_script(const EngineRequest& request);

}  // namespace kds
