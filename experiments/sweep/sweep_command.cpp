#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/progress_bar.h"
#include "experiments/sweep/collect_sweep.h"
#include "experiments/sweep/engine_scripts.h"
#include "experiments/sweep/estimate_sweep.h"
#include "experiments/sweep/run_sweep.h"
#include "experiments/sweep/sweep_folder.h"
#include "experiments/sweep/sweep_options.h"
#include "experiments/sweep/sweep_status.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr int kContinueLater = 75;  // EX_TEMPFAIL

constexpr CommandSpec kSweepCommand{
    "kds sweep",
    "Runs a command for all combinations of inputs and options that SWEEP.json lists. Each combination is a "
    "task of\n"
    "its own. Tasks run on all cores of this machine, or as batches of a cluster. The same command continues "
    "an\n"
    "interrupted sweep: only tasks without a result run. docs/formats.md describes SWEEP.json, "
    "docs/cluster.md shows\n"
    "how to run it on a cluster.\n\n"
    "  kds sweep SWEEP.json -o DIR   run all tasks that have no result in DIR\n"
    "  kds sweep status DIR          count the tasks that are done, running, failed and open\n"
    "  kds sweep collect DIR         write results.csv, results.json, pooled.csv, times.csv, failed.csv and\n"
    "                                report.html to DIR; exit code 1 if a task has no result",
    "[SWEEP.json]...",
    "the sweep, or status or collect with the folder of a sweep",
    "kds sweep sweep.json --dry-run\n"
    "kds sweep sweep.json -o out --task-seconds 600 --task-memory 4G\n"
    "kds sweep sweep.json -o out --write slurm\n"
    "kds sweep collect out",
};

void write_script(const fs::path& sweep, const SweepOptions& options, std::size_t jobs,
                  const std::vector<SweepEstimate>& estimates) {
  EngineRequest request;
  std::error_code error;
  request.program = fs::read_symlink("/proc/self/exe", error);
  if (error) request.program = "kds";
  request.sweep = fs::absolute(sweep);
  request.folder = fs::absolute(*options.out);
  request.jobs = jobs;
  request.hours = sum_of_hours(estimates);
  for (const SweepEstimate& estimate : estimates) {
    request.tasks += estimate.open;
    request.planned += estimate.tasks;
    request.longest = std::max(request.longest, estimate.longest);
  }
  request.task_memory = options.task_memory;
  Arguments others;
  if (options.task_seconds)
    others.insert(others.end(), {"--task-seconds", fmt::format("{}", *options.task_seconds)});
  if (options.task_memory)
    others.insert(others.end(), {"--task-memory", std::to_string(*options.task_memory)});
  if (!others.empty()) request.options = shell_words(others);
  const SweepEngine engine = *options.write;
  AtomicFiles files;
  files.write(request.folder / script_name(engine), engine_script(engine, request));
  commit_together({&files});
  const Batches batches = batches_of(request);
  constexpr double longest_batch = 30 * 60;
  std::string text = fmt::format("{} of about {} minutes\n", batches_text(batches.count),
                                 short_decimal(batches.seconds / 60));
  if (batches.seconds > longest_batch)
    text += "batches are longer than half an hour; --jobs with more cores of a node makes them shorter\n";
  if (engine == SweepEngine::slurm && !options.task_memory)
    text += "the script asks for no memory; with --task-memory SIZE it asks for that of its tasks\n";
  if (engine == SweepEngine::slurm && options.task_seconds &&
      *options.task_seconds > static_cast<double>(batches.budget_seconds))
    text += fmt::format(
        "--task-seconds {:g} is longer than a batch, which stops after {} s; if a task may need it, raise "
        "--time and --time-budget in the script\n",
        *options.task_seconds, batches.budget_seconds);
  print_to_stdout(text + start_command(engine, request) + "\n");
}

// Returns why no script is written, if no task is open.
std::string nothing_left(const SweepPlan& plan, const fs::path& sweep, const fs::path& folder) {
  const SweepCount all = count_tasks(plan, folder).back();
  if (all.done == all.tasks)
    return fmt::format("all {} tasks have results, so there is no script to write; kds sweep collect {}\n",
                       with_thousands(all.tasks), shell_words({folder.string()}));
  return fmt::format(
      "no task is left to run, so there is no script to write: {} of {} tasks have results, {} failed, {} "
      "crashed; kds sweep {} --retry runs these again\n",
      with_thousands(all.done), with_thousands(all.tasks), with_thousands(all.failed),
      with_thousands(all.crashed), shell_words({sweep.string(), "-o", folder.string()}));
}

// Results are named by the content of inputs, so those of an input that is gone are found all the same.
void warn_of_gone(const InputHashes& hashes) {
  constexpr std::size_t most_named = 3;
  const std::vector<std::string> gone = hashes.gone();
  ProgressBar none(false, "task");
  for (std::size_t k = 0; k < std::min(gone.size(), most_named); ++k)
    print_warning(none, gone[k] + ": cannot be read any more; its tasks are those of its last content");
  if (gone.size() > most_named)
    print_warning(none, fmt::format("{} more cannot be read any more", gone.size() - most_named));
}

// `kds sweep status DIR` and `kds sweep collect DIR`.
int look_at(const std::string& what, const fs::path& folder) {
  const KeptPlan kept = kept_plan(folder);
  InputHashes hashes([] { return false; });
  hashes.load(folder);
  PatternFiles found_before(hashes, kept.files);
  const SweepPlan plan(read_sweep(kept.sweep, kept.relative, found_before, kept.subject), hashes,
                       kept.subject);
  warn_of_gone(hashes);
  if (what == "status") {
    print_to_stdout(status_text(count_tasks(plan, folder)));
    return 0;
  }
  const CollectedSweep found =
      collect_sweep(plan, folder, "kds sweep collect " + shell_words({folder.string()}));
  std::string text = fmt::format("{} of {} tasks have results: {} rows\n", with_thousands(found.done),
                                 with_thousands(found.tasks), with_thousands(found.rows));
  if (found.failed + found.crashed > 0)
    text += fmt::format("{} failed and {} crashed; failed.csv says why and how to repeat them\n",
                        found.failed, found.crashed);
  if (found.missing > 0)
    text += fmt::format("{} are missing, such as\n  {}\n", with_thousands(found.missing),
                        fmt::join(found.first_missing, "\n  "));
  if (found.damaged > 0) text += fmt::format("{} damaged records were left out\n", found.damaged);
  print_to_stdout(text);
  print_report_path(folder);
  return found.done == found.tasks ? 0 : 1;
}

int run_shard(const SweepPlan& plan, InputHashes& hashes, const SweepOptions& options,
              const SweepLimits& limits, TaskLauncher& launcher, StopSignals& signals) {
  const fs::path& folder = *options.out;
  ProgressBar bar(!options.quiet, "task");
  const SweepOutcome outcome = run_sweep(
      plan, hashes, folder, limits, launcher, signals,
      [&bar](std::size_t done, std::size_t total) { bar.update(done, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); });
  bar.erase();
  const bool whole = limits.shard.count == 1;
  const std::size_t lost = outcome.failed + outcome.crashed;
  if (whole) static_cast<void>(write_failed(plan, folder));
  if (!options.quiet) {
    std::string text = fmt::format("{} of {} tasks{} have results, {} failed, {} crashed\n",
                                   with_thousands(outcome.done), with_thousands(outcome.tasks),
                                   whole ? "" : " of the shard", outcome.failed, outcome.crashed);
    if (lost > 0)
      text += whole ? fmt::format("see {}; --retry runs them again\n", (folder / "failed.csv").string())
                    : std::string("kds sweep collect lists them; --retry runs them again\n");
    if (outcome.without_input > 0)
      text += fmt::format("{} wait for inputs that cannot be read; the same command continues\n",
                          with_thousands(outcome.without_input));
    if (outcome.stopped) text += "stopped before the end; the same command continues\n";
    print_to_stdout(text);
  }
  if (outcome.stopped) return kContinueLater;
  return lost + outcome.without_input > 0 ? 1 : 0;
}

}  // namespace

int sweep_command(const Arguments& arguments) {
  const auto begin = TaskProcess::Clock::now();
  SweepOptions options;
  const ParsedArguments parsed = read_arguments(kSweepCommand, sweep_options(), arguments, options);
  const std::vector<std::string>& operands = parsed.operands();
  if (operands.empty())
    throw InputError("kds sweep needs SWEEP.json, or status or collect with a folder (see kds sweep --help)");
  if (operands.size() == 2) {
    const std::array<std::string_view, 2> known{"status", "collect"};
    static_cast<void>(place_among("kds sweep", operands[0], known));
    for (const auto& option : sweep_options().all())
      if (parsed.has(option.spec.name))
        throw InputError(fmt::format("{}: has no meaning for kds sweep {}", option.spec.name, operands[0]));
    return look_at(operands[0], operands[1]);
  }
  if (operands.size() > 2)
    throw InputError(
        fmt::format("kds sweep takes one SWEEP.json, not {} (see kds sweep --help)", operands.size()));
  if (operands[0] == "status" || operands[0] == "collect")
    throw InputError(fmt::format("kds sweep {} needs the folder of a sweep", operands[0]));
  refuse_conflicts(parsed);
  if (!options.out && !options.dry_run)
    throw InputError("kds sweep needs -o DIR, the folder of the results, or --dry-run");

  const bool runs = !options.dry_run && !options.write;
  std::optional<TaskLauncher> launcher;
  if (runs) launcher.emplace();  // before the plan takes memory
  const fs::path file = operands[0];
  const Json sweep = read_json(text_of_sweep(file), file.string());
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  StopSignals signals;
  InputHashes hashes([&signals] { return signals.stopped(); });
  if (options.out) hashes.load(*options.out);
  PatternFiles found_files(hashes);
  SweepSpec spec = read_sweep(sweep, folder, found_files, file.string());
  const Shard shard = shard_of(options);
  std::size_t jobs = jobs_of(options);
  if (const std::size_t most = most_tasks_at_once(); runs && jobs > most) {
    if (options.jobs)
      throw InputError(fmt::format(
          "--jobs: {} tasks at a time need more open files than this process may have (ulimit -n); "
          "expected at most {}",
          jobs, most));
    jobs = most;
  }
  if (options.out && !options.dry_run) check_sweep_folder(*options.out);
  try {
    const SweepPlan plan(std::move(spec), hashes, file.string());
    warn_of_gone(hashes);
    if (options.out && !options.dry_run) {
      keep_plan(*options.out, sweep, folder, found_files);
      hashes.save(*options.out);
    }
    if (runs) {
      SweepLimits limits;
      limits.begin = begin;
      limits.shard = shard;
      limits.jobs = jobs;
      limits.task_seconds = options.task_seconds;
      limits.task_memory = options.task_memory;
      limits.budget = options.time_budget;
      limits.retry = options.retry;
      return run_shard(plan, hashes, options, limits, *launcher, signals);
    }
    const std::vector<SweepEstimate> estimates =
        estimate_sweep(plan, hashes, options.out, options.retry, options.task_seconds, signals);
    if (options.write && std::ranges::all_of(estimates, [](const auto& one) { return one.open == 0; })) {
      print_to_stdout(nothing_left(plan, file, *options.out));
      return 0;
    }
    print_to_stdout(estimates_text(plan, estimates, jobs));
    if (options.write) write_script(file, options, jobs, estimates);
    return 0;
  } catch (const SweepStopped&) {
    return kContinueLater;
  }
}

}  // namespace kds
