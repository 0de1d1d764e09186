#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "experiments/output/output_files.h"
#include "experiments/output/report_page.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/progress_bar.h"
#include "experiments/sweep/collect_sweep.h"
#include "experiments/sweep/engine_scripts.h"
#include "experiments/sweep/refuse.h"
#include "experiments/sweep/run_sweep.h"
#include "experiments/sweep/sweep_folder.h"
#include "experiments/sweep/sweep_options.h"
#include "experiments/sweep/sweep_status.h"
#include "motions/base/text_input.h"
#include "structures/session/parallel_run.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr int kContinueLater = 75;        // EX_TEMPFAIL
constexpr std::size_t kMostWarnings = 3;  // warnings of one kind
constexpr std::size_t kBatches = 100;     // batches of a script

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
    "  kds sweep status DIR          count the tasks that are done, failed and open\n"
    "  kds sweep collect DIR         write results.csv, results.json, pooled.csv, times.csv, failed.csv,\n"
    "                                warnings.csv and report.html to DIR; exit code 1 if a task has no "
    "result",
    "[SWEEP.json]...",
    "the sweep, or status or collect with the folder of a sweep",
    "kds sweep sweep.json --dry-run\n"
    "kds sweep sweep.json -o out --task-seconds 600 --task-memory 4G\n"
    "kds sweep sweep.json -o out --write slurm\n"
    "kds sweep collect out",
};

void warn_of(const std::vector<std::string>& warnings) {
  ProgressBar none(false, "task");
  for (std::size_t k = 0; k < std::min(warnings.size(), kMostWarnings); ++k) print_warning(none, warnings[k]);
  if (warnings.size() > kMostWarnings)
    print_warning(none, fmt::format("more warnings of this kind: {}", warnings.size() - kMostWarnings));
}

// Results are named by the content of inputs, so those of an input that is gone are found all the same.
void warn_of_inputs(const SweepPlan& plan, const InputFiles& files) {
  std::vector<std::string> gone;
  for (const std::string& file : files.gone())
    gone.push_back(file + ": cannot be read any more; its tasks are those of its last content");
  warn_of(gone);
  warn_of(plan.copies());
}

// `kds sweep status DIR` and `kds sweep collect DIR`.
int look_at(const std::string& what, const fs::path& folder) {
  const KeptPlan kept = kept_plan(folder);
  if (kept.sweep.is_null()) refuse("{}: is no folder of a sweep (it has no plan.json)", folder.string());
  InputFiles files(kept.inputs, InputFiles::Patterns::now_and_before);
  const SweepPlan plan(read_sweep(kept.sweep, kept.relative, files, kept.subject), files, kept.subject);
  warn_of_inputs(plan, files);
  const TaskStates states(results_folder(folder));
  const std::string others = other_versions_text(states);
  if (what == "status") {
    const bool runs = ShardLock::taken(folder);
    print_to_stdout(counts_text(count_tasks(plan, states, runs)) +
                    (runs ? "a sweep runs in this folder; its tasks are open until they end\n" : "") +
                    others);
    return 0;
  }
  const CollectedSweep found =
      collect_sweep(plan, states, folder, "kds sweep collect " + shell_words({folder.string()}));
  const SweepCount& all = found.all;
  std::string text = fmt::format("{} of {} tasks have results: {} rows\n", with_thousands(all.done),
                                 with_thousands(all.tasks), with_thousands(found.rows));
  if (all.failed + all.crashed > 0)
    text += fmt::format("{} failed and {} crashed; failed.csv says why and how to repeat them\n", all.failed,
                        all.crashed);
  if (all.warned > 0) text += fmt::format("{} have warnings, which warnings.csv lists\n", all.warned);
  if (all.open > 0)
    text += fmt::format("{} are missing, such as\n  {}\n", with_thousands(all.open),
                        fmt::join(found.first_missing, "\n  "));
  if (states.damaged() > 0)
    text += fmt::format("{} left out, because damaged\n", counted(states.damaged(), "record"));
  print_to_stdout(text + others);
  print_report_path(folder);
  return all.done == all.tasks ? 0 : 1;
}

int run_shard(const SweepPlan& plan, InputFiles& files, const SweepOptions& options, StopSignals& signals) {
  const SweepOutcome outcome = run_sweep(plan, files, options, signals);
  const SweepCount& count = outcome.count;
  const fs::path& folder = *options.out;
  const bool whole = options.shard.count == 1, lost = count.failed + count.crashed > 0;
  if (whole) write_failed(plan, TaskStates(results_folder(folder)), folder);
  std::string text =
      fmt::format("{} of {} tasks{} have results, {} failed, {} crashed\n", with_thousands(count.done),
                  with_thousands(count.tasks), whole ? "" : " of the shard", count.failed, count.crashed);
  if (lost)
    text += whole ? fmt::format("see {}; --retry runs them again\n", (folder / "failed.csv").string())
                  : std::string("kds sweep collect lists them; --retry runs them again\n");
  if (count.warned > 0)
    text += fmt::format("{} have warnings; kds sweep collect lists them\n", with_thousands(count.warned));
  if (outcome.without_input > 0)
    text += fmt::format("{} wait for inputs that cannot be read; the same command continues\n",
                        with_thousands(outcome.without_input));
  if (outcome.stopped()) text += "stopped before the end; the same command continues\n";
  if (!options.quiet) print_to_stdout(text);
  if (outcome.stopped()) return kContinueLater;
  return lost || outcome.without_input > 0 ? 1 : 0;
}

// Writes a script that runs the sweep, unless no task is open.
void write_script(const fs::path& sweep, const SweepOptions& options, const SweepCount& all) {
  EngineRequest request;
  std::error_code error;
  request.engine = *options.write;
  request.program = fs::read_symlink("/proc/self/exe", error);
  if (error) request.program = "kds";
  request.sweep = fs::absolute(sweep);
  request.folder = fs::absolute(*options.out);
  request.tasks = all.tasks;
  request.batches = options.batches.value_or(std::min(kBatches, all.tasks));
  request.jobs = *options.jobs;
  request.seconds = static_cast<std::size_t>(options.time_budget.value_or(3600));
  request.task_memory = options.task_memory;
  if (options.task_seconds) request.options += fmt::format(" --task-seconds {}", *options.task_seconds);
  if (options.task_memory) request.options += fmt::format(" --task-memory {}", *options.task_memory);
  const std::string script = engine_script(request);
  if (all.open == 0)
    return print_to_stdout(
        fmt::format("no task is left to run, so there is no script to write; kds sweep collect {}\n",
                    shell_words({options.out->string()})));
  AtomicFiles out;
  out.write(request.folder / script_name(request.engine), script);
  commit_together({&out});
  std::string text =
      request.batches == 1 ? "1 batch\n" : fmt::format("{} batches\n", with_thousands(request.batches));
  if (request.engine == SweepEngine::slurm && !options.task_memory)
    text += "the script asks for no memory; with --task-memory SIZE it asks for that of its tasks\n";
  if (request.engine == SweepEngine::slurm && options.task_seconds &&
      *options.task_seconds > static_cast<double>(request.seconds))
    text += fmt::format(
        "--task-seconds {:g} is longer than a batch, which stops after {} s; expected a larger "
        "--time-budget\n",
        *options.task_seconds, request.seconds);
  print_to_stdout(text + start_command(request) + "\n");
}

int sweep(const fs::path& file, SweepOptions options) {
  const bool runs = !options.write && !options.dry_run;
  if (!options.jobs) options.jobs = runs ? all_threads() : 1;
  StopSignals signals;
  const Json text = read_json(text_of_sweep(file), file.string());
  const fs::path relative = fs::absolute(file).lexically_normal().parent_path();
  if (options.out && !options.dry_run) check_sweep_folder(*options.out);
  const KeptPlan kept = options.out ? kept_plan(*options.out) : KeptPlan();
  InputFiles files(kept.inputs, InputFiles::Patterns::now, [&signals] { return signals.stopped(); });
  const SweepPlan plan(read_sweep(text, relative, files, file.string()), files, file.string());
  warn_of_inputs(plan, files);
  if (!options.dry_run && !kept.sweep.is_null() && line_of(kept.sweep) != line_of(text))
    warn_of({fmt::format(
        "{}: {} differs from the sweep that this folder had; results of tasks that are no longer in "
        "it stay, but are not collected",
        options.out->string(), file.string())});
  if (!options.dry_run) keep_plan(*options.out, text, relative, files);
  if (runs) return run_shard(plan, files, options, signals);
  TaskStates states(options.out ? results_folder(*options.out) : fs::path());
  if (options.retry) states.forgive();
  const std::vector<SweepCount> counts = count_tasks(plan, states, false);
  std::string lines = counts_text(counts) + other_versions_text(states);
  if (plan.excluded() > 0) lines += fmt::format("{} are excluded\n", with_thousands(plan.excluded()));
  print_to_stdout(lines);
  if (options.write) write_script(file, options, counts.back());
  return 0;
}

}  // namespace

int sweep_command(const Arguments& arguments) {
  SweepOptions options;
  const ParsedArguments parsed = read_arguments(kSweepCommand, sweep_options(), arguments, options);
  const std::vector<std::string>& operands = parsed.operands();
  if (operands.empty())
    refuse("kds sweep needs SWEEP.json, or status or collect with a folder (see kds sweep --help)");
  if (operands.size() == 2) {
    const std::array<std::string_view, 2> known{"status", "collect"};
    static_cast<void>(index_among("kds sweep", operands[0], known));
    for (const auto& option : sweep_options().all())
      if (parsed.has(option.spec.name))
        refuse("{}: has no meaning for kds sweep {}", option.spec.name, operands[0]);
    return look_at(operands[0], operands[1]);
  }
  if (operands.size() > 2)
    refuse("kds sweep takes one SWEEP.json, not {} (see kds sweep --help)", operands.size());
  if (operands[0] == "status" || operands[0] == "collect")
    refuse("kds sweep {} needs the folder of a sweep", operands[0]);
  refuse_conflicts(parsed);
  if (!options.out && !options.dry_run)
    refuse("kds sweep needs -o DIR, the folder of the results, or --dry-run");
  try {
    return sweep(operands[0], options);
  } catch (const SweepStopped&) {
    return kContinueLater;
  } catch (const TryLater& reason) {
    std::fputs(fmt::format("kds: {}\n", one_line(reason.what())).c_str(), stderr);
    return kContinueLater;
  }
}

}  // namespace kds
