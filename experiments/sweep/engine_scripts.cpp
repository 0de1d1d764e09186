#include "experiments/sweep/engine_scripts.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/sweep/refuse.h"

namespace kds {

namespace {

constexpr std::size_t kSecondsToStop = 120;  // the time limit minus the time budget

// Returns how many units hold this amount.
std::uint64_t in_units(std::uint64_t amount, std::uint64_t unit) { return (amount + unit - 1) / unit; }

constexpr std::string_view kSlurm = R"(#!/bin/bash
# Submits {tasks} tasks as an array of batches, and a job that collects their results. Add what the cluster needs, such
# as --account or --partition, to both commands sbatch. Without --task-memory, no memory is asked for: add --mem.
# A batch that nears its time limit stops with exit code 75. The cluster then requeues the batch if it has
# RequeueExit=75 (scontrol show config). Otherwise submit this script again: only tasks without a result run.
set -eu
array=$(sbatch --parsable --array=1-{count} --cpus-per-task={jobs}{mem} --time={limit} --requeue --open-mode=append \
  --signal=B:USR1@{stop} --job-name=kds-sweep --output={log} <<'BATCH'
#!/bin/bash
exec {sweep} --shard "$SLURM_ARRAY_TASK_ID/{count}" --time-budget {budget}
BATCH
)
sbatch --parsable --dependency="afterany:${{array%%;*}}"{mem} --time=60 --job-name=kds-collect --output={collect_log} <<'COLLECT'
#!/bin/bash
exec {collect}
COLLECT
)";

constexpr std::string_view kParallel = R"(#!/bin/bash
# Runs {tasks} tasks in {count} batches by GNU parallel. Each batch takes {jobs} of the cores of this machine. For other
# machines that share this folder, add --sshlogin HOSTS. Run it again to continue: only tasks without a result run.
set -u
batch() {{ {sweep} --quiet --shard "$1/{count}"; }}
export -f batch  # in the words of a command, parallel would replace braces
seq {count} | parallel --env batch --jobs {percent}% batch || true  # collect says what is missing
exec {collect}
)";

constexpr std::string_view kSnakemake =
    R"(# Runs {tasks} tasks in {count} batches: snakemake -s Snakefile --cores all
# The files of batches are temporary, so that each start visits all batches: kds knows which tasks have results.
# Exit code 1 says that tasks failed, which failed.csv lists; all other tasks run.
rule collect:
    input: expand("batches/{{i}}", i=range(1, {count} + 1))
{resources}    shell: "{collect} || [ $? -eq 1 ]"

rule batch:
    output: temp(touch("batches/{{i}}"))
    threads: {jobs}
{resources}    retries: 3
    shell: "{sweep} --quiet --shard {{wildcards.i}}/{count} || [ $? -eq 1 ]"
)";

}  // namespace

std::optional<std::uint64_t> batch_memory(const EngineRequest& request) {
  if (!request.task_memory) return std::nullopt;
  constexpr std::uint64_t own = std::uint64_t{128} << 20U, of_task = 1024;
  return request.jobs * *request.task_memory + own + of_task * request.tasks;
}

std::string script_name(SweepEngine engine) {
  constexpr std::array names{"slurm.sh", "parallel.sh", "Snakefile"};
  return names[static_cast<std::size_t>(engine)];
}

std::string start_command(const EngineRequest& request) {
  const std::string script = shell_words({(request.folder / script_name(request.engine)).string()});
  if (request.engine != SweepEngine::snakemake) return "bash " + script;
  return fmt::format("snakemake -d {} -s {} --cores all", shell_words({request.folder.string()}), script);
}

std::string engine_script(const EngineRequest& request) {
  const auto engine = static_cast<std::size_t>(request.engine);
  for (const auto* path : {&request.program, &request.sweep, &request.folder})
    if (std::ranges::any_of(path->string(), [](char c) {
          return static_cast<unsigned char>(c) < ' ' ||
                 std::string_view("\\\"%{}\x7f").find(c) != std::string_view::npos;
        }))
      refuse(
          "--write {}: '{}' has a line break or one of \\ \" % {{ }} in its name, which scripts "
          "cannot quote; "
          "expected another name",
          name_of(request.engine), one_line(path->string()));
  const auto words = [](const std::filesystem::path& path) { return shell_words({path.string()}); };
  const auto memory = batch_memory(request);
  constexpr std::array scripts{kSlurm, kParallel, kSnakemake};
  return fmt::format(
      fmt::runtime(scripts[engine]), fmt::arg("tasks", with_thousands(request.tasks)),
      fmt::arg("count", request.batches), fmt::arg("jobs", request.jobs),
      fmt::arg("percent", in_units(100, request.jobs)),
      fmt::arg("limit", in_units(request.seconds + kSecondsToStop, 60)), fmt::arg("stop", kSecondsToStop),
      fmt::arg("budget", request.seconds),
      fmt::arg("mem", memory ? fmt::format(" --mem={}M", in_units(*memory, std::uint64_t{1} << 20U)) : ""),
      // Engines of Snakemake take mem_mb as 10^6 or as 2^20 bytes. The larger number is enough for both.
      fmt::arg("resources",
               memory ? fmt::format("    resources: mem_mb={}\n", in_units(*memory, 1'000'000)) : ""),
      fmt::arg("log", words(request.folder / "slurm-%A_%a.out")),
      fmt::arg("collect_log", words(request.folder / "slurm-collect.out")),
      fmt::arg("sweep",
               fmt::format("{} sweep {} -o {} --jobs {}{}", words(request.program), words(request.sweep),
                           words(request.folder), request.jobs, request.options)),
      fmt::arg("collect", fmt::format("{} sweep collect {}", words(request.program), words(request.folder))));
}

}  // namespace kds
