#include "experiments/sweep/sweep_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "structures/session/parallel_run.h"

namespace kds {

namespace {

Shard parse_shard(const std::string& text) {
  const auto refuse = [&] {
    throw InputError(fmt::format("--shard: '{}' is not I/N, whole numbers from 1 with I at most N", text));
  };
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) refuse();
  constexpr std::uint64_t most = 1'000'000'000;
  Shard shard;
  try {
    shard.number = parse_whole_number("--shard", std::string_view(text).substr(0, slash), 1, most);
    shard.count = parse_whole_number("--shard", std::string_view(text).substr(slash + 1), 1, most);
  } catch (const InputError&) {
    refuse();
  }
  if (shard.number > shard.count) refuse();
  return shard;
}

std::uint64_t parse_memory(const std::string& text) {
  constexpr std::string_view units = "KMGT";
  std::string_view digits(text);
  unsigned shift = 0;
  if (const std::size_t unit = text.empty() ? std::string::npos : units.find(text.back());
      unit != std::string::npos) {
    shift = 10 * (static_cast<unsigned>(unit) + 1);
    digits.remove_suffix(1);
  }
  constexpr std::uint64_t least = std::uint64_t{64} << 20U;  // below, no command starts
  constexpr std::uint64_t most = std::uint64_t{64} << 40U;
  const auto number = parse_count(digits);
  if (!number || *number > most >> shift || *number << shift < least)
    throw InputError(
        fmt::format("--task-memory: '{}' is not a number of bytes with K, M, G or T, from 64M to 64T", text));
  return *number << shift;
}

}  // namespace

const OptionList<SweepOptions>& sweep_options() {
  using O = SweepOptions;
  static const auto list = OptionList<O>(
      {path_option({"-o", "DIR", "folder of the sweep's results; required, except for --dry-run"}, &O::out),
       flag_option(
           "--dry-run",
           "run nothing but one task of each command, and print how many tasks there are and how long "
           "they may take",
           &O::dry_run),
       value_option(
           {"--shard", "I/N",
            "run tasks I, I + N, I + 2 N, ... only; I is from 1 to N (default: an element of a Slurm "
            "array runs its share, otherwise all)"},
           &O::shard, parse_shard,
           [](const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }),
       whole_option(
           {"--jobs", "N",
            "tasks to run at a time (default: SLURM_CPUS_PER_TASK if it is set, otherwise all cores; with "
            "--write: 1)"},
           &O::jobs, 1, 100'000),
       flag_option("--retry", "run tasks again that failed or crashed", &O::retry),
       real_option({"--task-seconds", "S", "a task that takes longer fails (default: no limit)"},
                   &O::task_seconds, {0.01, 1e9}),
       value_option(
           {"--task-memory", "SIZE",
            "a task that needs more memory fails: bytes, or with K, M, G or T, as in 4G; scripts of --write "
            "ask for this memory (default: no limit)"},
           &O::task_memory, parse_memory, [](std::uint64_t bytes) { return std::to_string(bytes); }),
       real_option({"--time-budget", "S",
                    "stop within S seconds, with exit code 75 if tasks are left (default: no limit)"},
                   &O::time_budget, {1, 1e9}),
       choice_option(
           {"--write", "ENGINE",
            "write a script that runs the sweep by slurm, parallel (GNU parallel) or snakemake to DIR, and "
            "run nothing but one task of each command"},
           &O::write, sweep_engine_names),
       flag_option("--quiet", "print no progress bar and no counts", &O::quiet)});
  return list;
}

void refuse_conflicts(const ParsedArguments& parsed) {
  const auto refuse = [&](std::string_view option, std::string_view other) {
    if (parsed.has(option) && parsed.has(other))
      throw InputError(fmt::format("{}: has no meaning beside {}; expected one of the two", option, other));
  };
  refuse("--dry-run", "--write");
  for (const std::string_view other : {"--dry-run", "--write"})
    for (const std::string_view option : {"--shard", "--time-budget"}) refuse(option, other);
  refuse("--retry", "--write");
}

Shard shard_of(const SweepOptions& options) {
  if (options.shard) return *options.shard;
  if (options.write || options.dry_run) return {};
  const auto from_slurm = [](const char* name) -> std::optional<std::uint64_t> {
    const char* const text = std::getenv(name);
    if (text == nullptr) return std::nullopt;
    return parse_whole_number(name, text, 0, 1'000'000'000);
  };
  const auto id = from_slurm("SLURM_ARRAY_TASK_ID"), count = from_slurm("SLURM_ARRAY_TASK_COUNT");
  if (!id || !count) return {};
  const std::uint64_t first = from_slurm("SLURM_ARRAY_TASK_MIN").value_or(1);
  const std::uint64_t step = std::max<std::uint64_t>(from_slurm("SLURM_ARRAY_TASK_STEP").value_or(1), 1);
  if (*id < first || (*id - first) % step != 0 || (*id - first) / step >= *count)
    throw InputError(
        fmt::format("SLURM_ARRAY_TASK_ID {} is not one of {} numbers from {} on with step {}, so its share "
                    "is unknown; expected --shard I/N",
                    *id, *count, first, step));
  return {(*id - first) / step + 1, *count};
}

std::size_t jobs_of(const SweepOptions& options) {
  if (options.jobs) return *options.jobs;
  if (options.write) return 1;
  if (const char* const cpus = std::getenv("SLURM_CPUS_PER_TASK"); cpus != nullptr)
    return parse_whole_number("SLURM_CPUS_PER_TASK", cpus, 1, 100'000);
  return all_threads();
}

}  // namespace kds
