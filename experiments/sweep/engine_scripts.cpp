#include "experiments/sweep/engine_scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::size_t kMostBatches = 1000;  // Slurm's default for the elements of an array
constexpr double kBatchSeconds = 15 * 60;
constexpr std::size_t kSpareMinutes = 10;

// The sweep stops this many seconds before the time limit.
constexpr std::size_t kSecondsToStop = 120;

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;

std::string sweep_words(const EngineRequest& request) {
  return fmt::format("{} sweep {} -o {} --jobs {}{}", shell_words({request.program.string()}),
                     shell_words({request.sweep.string()}), shell_words({request.folder.string()}),
                     request.jobs, request.options.empty() ? "" : " " + request.options);
}

std::string collect_words(const EngineRequest& request) {
  return fmt::format("{} sweep collect {}", shell_words({request.program.string()}),
                     shell_words({request.folder.string()}));
}

// Returns how many units hold this amount.
std::uint64_t in_units(std::uint64_t amount, std::uint64_t unit) { return (amount + unit - 1) / unit; }

// Slurm replaces % and a letter in the name of a log.
std::string log_word(const EngineRequest& request, std::string_view name) {
  std::string path;
  for (const char c : request.folder.string()) path.append(c == '%' ? 2 : 1, c);
  return shell_words({fmt::format("{}/{}", path, name)});
}

std::string slurm_script(const EngineRequest& request) {
  const Batches batches = batches_of(request);
  const std::string log = log_word(request, "slurm-%A_%a.out");
  const auto memory = batch_memory(request);
  const std::string mem = memory ? fmt::format(" --mem={}M", in_units(*memory, kMebibyte)) : std::string();
  return fmt::format(
      R"(#!/bin/bash
# Submits {tasks} tasks as an array of {batches} of about {minutes:.1f} minutes, and a job that collects their
# results. Add what the cluster needs, such as --account or --partition, to both commands sbatch.
# {about_memory}
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
)",
      fmt::arg("tasks", with_thousands(request.tasks)), fmt::arg("batches", batches_text(batches.count)),
      fmt::arg("count", batches.count), fmt::arg("minutes", batches.seconds / 60),
      fmt::arg("jobs", request.jobs), fmt::arg("mem", mem),
      fmt::arg("about_memory",
               memory
                   ? fmt::format("--mem is the memory of {} by --task-memory, and that of the sweep itself.",
                                 request.jobs == 1 ? "a task" : fmt::format("{} tasks", request.jobs))
                   : "No memory is asked for, so that the cluster's default holds: add --mem, or write this "
                     "script with --task-memory."),
      fmt::arg("limit", batches.limit_minutes), fmt::arg("stop", kSecondsToStop), fmt::arg("log", log),
      fmt::arg("sweep", sweep_words(request)), fmt::arg("budget", batches.budget_seconds),
      fmt::arg("collect", collect_words(request)),
      fmt::arg("collect_log", log_word(request, "slurm-collect.out")));
}

std::string parallel_script(const EngineRequest& request) {
  const Batches batches = batches_of(request);
  const std::string cores = request.jobs == 1 ? "each core" : fmt::format("each {} cores", request.jobs);
  return fmt::format(
      R"(#!/bin/bash
# Runs {tasks} tasks in {batches} by GNU parallel, one batch at a time for {cores} of this machine. For other
# machines that share this folder, add --sshlogin HOSTS. Run it again to continue: only tasks without a result run.
set -u
batch() {{ {sweep} --quiet --shard "$1/{count}"; }}
export -f batch  # in the words of a command, parallel would replace braces
seq {count} | parallel --env batch --jobs {percent}% batch || true  # collect says what is missing
exec {collect}
)",
      fmt::arg("tasks", with_thousands(request.tasks)), fmt::arg("batches", batches_text(batches.count)),
      fmt::arg("cores", cores), fmt::arg("count", batches.count),
      fmt::arg("percent", in_units(100, request.jobs)), fmt::arg("sweep", sweep_words(request)),
      fmt::arg("collect", collect_words(request)));
}

// In a Snakefile, braces of shell commands are doubled, and backslashes, quotes and line breaks of Python
// strings escaped.
std::string in_python(const std::string& shell) {
  std::string text;
  for (const char c : shell) {
    if (c == '\\' || c == '"') text += '\\';
    if (c == '{' || c == '}') text += c;
    if (c == '\n')
      text += "\\n";
    else if (c == '\r')
      text += "\\r";
    else
      text += c;
  }
  return text;
}

std::string snakemake_script(const EngineRequest& request) {
  const Batches batches = batches_of(request);
  const auto memory = batch_memory(request);
  // Engines of Snakemake take mem_mb as 10^6 or as 2^20 bytes. The larger number is enough for both.
  const std::string resources =
      memory ? fmt::format("    resources: mem_mb={}\n", in_units(*memory, 1'000'000)) : std::string();
  return fmt::format(
      R"(# Runs {tasks} tasks in {batches}: snakemake -s {name} --cores all
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
)",
      fmt::arg("tasks", with_thousands(request.tasks)), fmt::arg("batches", batches_text(batches.count)),
      fmt::arg("count", batches.count), fmt::arg("name", script_name(SweepEngine::snakemake)),
      fmt::arg("collect", in_python(collect_words(request))), fmt::arg("jobs", request.jobs),
      fmt::arg("resources", resources), fmt::arg("sweep", in_python(sweep_words(request))));
}

}  // namespace

Batches batches_of(const EngineRequest& request) {
  const double seconds = request.hours * 3600 / static_cast<double>(request.jobs);
  const double wanted = std::ceil(seconds / kBatchSeconds);
  Batches batches;
  const std::size_t most = std::min(kMostBatches, std::max<std::size_t>(request.tasks, 1));
  batches.count =
      wanted >= static_cast<double>(most) ? most : std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
  batches.seconds = seconds / static_cast<double>(batches.count);
  const double longest = 2 * std::max(batches.seconds, request.longest);
  batches.limit_minutes = static_cast<std::size_t>(std::ceil(longest / 60)) + kSpareMinutes;
  batches.budget_seconds = batches.limit_minutes * 60 - kSecondsToStop;
  return batches;
}

std::optional<std::uint64_t> batch_memory(const EngineRequest& request) {
  if (!request.task_memory) return std::nullopt;
  constexpr std::uint64_t own = 128 * kMebibyte, of_planned_task = 1024;
  return request.jobs * *request.task_memory + own + of_planned_task * request.planned;
}

std::string batches_text(std::size_t count) {
  return with_thousands(count) + (count == 1 ? " batch" : " batches");
}

std::string script_name(SweepEngine engine) {
  return engine == SweepEngine::snakemake ? "Snakefile" : std::string(name_of(engine)) + ".sh";
}

std::string start_command(SweepEngine engine, const EngineRequest& request) {
  const std::string folder = shell_words({request.folder.string()});
  const std::string script = shell_words({(request.folder / script_name(engine)).string()});
  return engine == SweepEngine::snakemake ? fmt::format("snakemake -d {} -s {} --cores all", folder, script)
                                          : "bash " + script;
}

std::string engine_script(SweepEngine engine, const EngineRequest& request) {
  switch (engine) {
    case SweepEngine::slurm:
      return slurm_script(request);
    case SweepEngine::parallel:
      return parallel_script(request);
    default:
      return snakemake_script(request);
  }
}

}  // namespace kds
