#include "experiments/sweep/sweep_options.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "experiments/sweep/refuse.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

Shard parse_shard(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto number = parse_count(text.substr(0, slash));
  const auto count = parse_count(text.substr(std::min(slash + 1, text.size())));
  constexpr std::uint64_t most = 1'000'000'000;
  if (!number || !count || *number < 1 || *number > *count || *count > most)
    refuse("--shard: '{}' is not I/N, whole numbers from 1 with I at most N", text);
  return {*number, *count};
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
    refuse("--task-memory: '{}' is not a number of bytes with K, M, G or T, from 64M to 64T", text);
  return *number << shift;
}

}  // namespace

const OptionList<SweepOptions>& sweep_options() {
  using O = SweepOptions;
  static const auto list = OptionList<O>(
      {path_option({"-o", "DIR", "folder of the sweep's results; required, except for --dry-run"}, &O::out),
       flag_option("--dry-run", "run nothing, and print how many tasks there are", &O::dry_run),
       value_option(
           {"--shard", "I/N", "run tasks I, I + N, I + 2 N, ... only; I is from 1 to N (default: all tasks)"},
           &O::shard, parse_shard,
           [](const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }),
       whole_option({"--jobs", "N",
                     "tasks to run at a time (default: all cores; with "
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
            "run nothing; --time-budget is that of each batch of Slurm (default: 3600)"},
           &O::write, sweep_engine_names),
       whole_option({"--batches", "N", "batches of the script of --write (default: 100, at most one a task)"},
                    &O::batches, 1, 1'000'000),
       flag_option("--quiet", "print no progress bar and no counts", &O::quiet)});
  return list;
}

void refuse_conflicts(const ParsedArguments& parsed) {
  for (const auto& [option, other] : {std::pair{"--dry-run", "--write"},
                                      {"--time-budget", "--dry-run"},
                                      {"--shard", "--dry-run"},
                                      {"--shard", "--write"},
                                      {"--retry", "--write"}})
    if (parsed.has(option) && parsed.has(other))
      refuse("{}: has no meaning beside {}; expected one of the two", option, other);
  if (parsed.has("--batches") && !parsed.has("--write"))
    refuse("--batches: has no meaning without --write; expected both or --shard I/N");
}

}  // namespace kds
