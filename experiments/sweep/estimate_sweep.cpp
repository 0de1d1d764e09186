#include "experiments/sweep/estimate_sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "experiments/sweep/run_sweep.h"
#include "experiments/sweep/swept_task.h"

namespace kds {

namespace {

Table<SweepEstimate> estimate_table() {
  using R = SweepEstimate;
  return {{
      {"command", "command", [](const R& r) { return Field(r.command); }},
      {"tasks", "tasks", [](const R& r) { return Field(r.tasks); }},
      {"open", "without a result", [](const R& r) { return Field(r.open); }},
      {.key = "seconds",
       .heading = "seconds of one task",
       .value = [](const R& r) { return r.open > 0 && r.error.empty() ? Field(r.seconds) : Field(); },
       .words = [](const R& r) { return (r.cut_off ? "more than " : "") + short_decimal(r.seconds); }},
      {.key = "hours",
       .heading = "core hours expected",
       .value = [](const R& r) { return r.error.empty() ? Field(r.hours) : Field(); },
       .words = [](const R& r) { return (r.cut_off ? "more than " : "") + short_decimal(r.hours); }},
      {"error", "the task failed", [](const R& r) { return text_or_nothing(r.error); }},
  }};
}

}  // namespace

std::vector<SweepEstimate> estimate_sweep(const SweepPlan& plan, const InputHashes& hashes,
                                          const std::optional<std::filesystem::path>& folder, bool retry,
                                          std::optional<double> task_seconds, StopSignals& signals) {
  constexpr double most_seconds = 60;
  TaskStates states(folder ? results_folder(*folder) : std::filesystem::path());
  if (folder) states.refresh();
  if (retry) states.forgive();
  struct Sized {
    double size;
    const SweepTask* task;
  };
  std::vector<std::vector<Sized>> open(plan.spec().blocks.size());
  std::vector<SweepEstimate> estimates(open.size());
  for (const SweepTask& task : plan.tasks()) {
    estimates[task.block].command = plan.text(task, "command");
    ++estimates[task.block].tasks;
    if (status_of(states.of(task.name)) == TaskStatus::open)
      open[task.block].push_back({plan.size(task, hashes), &task});
  }
  for (std::size_t block = 0; block < open.size(); ++block) {
    SweepEstimate& estimate = estimates[block];
    std::vector<Sized>& tasks = open[block];
    estimate.open = tasks.size();
    if (tasks.empty()) continue;
    const auto middle = tasks.begin() + static_cast<std::ptrdiff_t>(tasks.size() / 2);
    std::ranges::nth_element(tasks, middle, {}, &Sized::size);
    const Sized median = *middle;
    const TrialRun run =
        try_task(plan, *median.task, std::min(most_seconds, task_seconds.value_or(most_seconds)), signals);
    estimate.seconds = run.seconds;
    estimate.cut_off = run.cut_off;
    estimate.error = run.error;
    for (const Sized& task : tasks) {
      const double seconds = run.seconds * task.size / median.size;
      estimate.hours += seconds / 3600;
      estimate.longest = std::max(estimate.longest, seconds);
    }
  }
  std::erase_if(estimates, [](const SweepEstimate& estimate) { return estimate.tasks == 0; });
  return estimates;
}

double sum_of_hours(const std::vector<SweepEstimate>& estimates) {
  double hours = 0;
  for (const SweepEstimate& estimate : estimates) hours += estimate.hours;
  return hours;
}

std::string estimates_text(const SweepPlan& plan, const std::vector<SweepEstimate>& estimates,
                           std::size_t jobs) {
  std::string text = estimate_table().text(estimates);
  const double hours = sum_of_hours(estimates);
  text += fmt::format("{} tasks", with_thousands(plan.tasks().size()));
  if (plan.excluded() > 0) text += fmt::format(", {} excluded", with_thousands(plan.excluded()));
  return text + fmt::format("; about {} hours with {} at a time, if time grows with the bytes of an input\n",
                            short_decimal(hours / static_cast<double>(jobs)), jobs);
}

}  // namespace kds
