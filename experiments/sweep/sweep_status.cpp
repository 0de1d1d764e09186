#include "experiments/sweep/sweep_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

std::string json_text(const Json& json, std::string_view name) {
  const Json* const found = json.find(name);
  return found != nullptr && found->text() != nullptr ? *found->text() : std::string();
}

}  // namespace

std::span<const SweepCount> without_repeated_sum(const std::vector<SweepCount>& counts) {
  return std::span(counts).first(counts.size() - (counts.size() == 2 ? 1 : 0));
}

Table<SweepCount> count_table() {
  using R = SweepCount;
  return {{
      {"command", "command", [](const R& r) { return Field(r.command); }},
      {"tasks", "tasks", [](const R& r) { return Field(r.tasks); }},
      {"done", "done", [](const R& r) { return Field(r.done); }},
      {"failed", "failed", [](const R& r) { return Field(r.failed); }},
      {"crashed", "crashed", [](const R& r) { return Field(r.crashed); }},
      {"running", "running", [](const R& r) { return Field(r.running); }},
      {"open", "open", [](const R& r) { return Field(r.open); }},
      {.key = "seconds",
       .heading = "seconds of tasks done",
       .value = [](const R& r) { return Field(r.seconds); },
       .format = shortly},
      {.key = "left",
       .heading = "core hours left",
       .value = [](const R& r) { return r.hours_left ? Field(*r.hours_left) : Field(); },
       .format = shortly},
  }};
}

Table<FailedTask> failed_table() {
  using R = FailedTask;
  return {{
      {"task", "task", [](const R& r) { return Field(r.task); }},
      {"command", "command", [](const R& r) { return Field(r.command); }},
      {"input", "input", [](const R& r) { return text_or_nothing(r.input); }},
      {"status", "status", [](const R& r) { return Field(r.status); }},
      {"code", "", [](const R& r) { return r.code > 0 ? Field(r.code) : Field(); }},
      {"error", "error", [](const R& r) { return Field(r.error); }},
      {"repeat", "repeat", [](const R& r) { return Field(r.repeat); }},
  }};
}

std::vector<FailedTask> failed_tasks(const SweepPlan& plan, const TaskStates& states) {
  std::vector<FailedTask> failed;
  for (const SweepTask& task : plan.tasks()) {
    const TaskState& state = states.of(task.name);
    const TaskStatus status = status_of(state);
    if (status != TaskStatus::failed && status != TaskStatus::crashed) continue;
    const bool crashed = status == TaskStatus::crashed;
    const RecordPlace& place = crashed ? state.death : state.failure;
    const Json json = place.length > 0 ? parse_json(states.read(place)) : Json();
    FailedTask& row = failed.emplace_back();
    row.task = hex_digits(task.name);
    row.command = plan.text(task, "command");
    row.input = plan.text(task, "input");
    row.status = crashed ? "crashed" : "failed";
    row.error = json_text(json, "error");
    if (row.error.empty()) row.error = "the sweep was killed";
    if (crashed) row.error = fmt::format("{} attempts left no result; the last {}", state.lost(), row.error);
    const Json* const code = json.find("code");
    row.code = code != nullptr && code->whole_number() != nullptr ? *code->whole_number() : 0;
    row.repeat = "kds " + shell_words(plan.arguments(task));
  }
  return failed;
}

std::vector<SweepCount> counts_from(const SweepPlan& plan, const TaskStates& states, const fs::path& folder) {
  std::vector<SweepCount> counts;
  const TaskLocks locks(locks_file(folder), TaskLocks::Use::look);
  SweepCount all;
  all.command = "all";
  for (const SweepTask& task : plan.tasks()) {
    const std::string command = plan.text(task, "command");
    auto count = std::ranges::find(counts, command, &SweepCount::command);
    if (count == counts.end()) {
      counts.emplace_back().command = command;
      count = counts.end() - 1;
    }
    const TaskState& state = states.of(task.name);
    const TaskStatus status = status_of(state);
    const bool settled = status == TaskStatus::done || status == TaskStatus::failed;
    const bool running = !settled && state.lost() > 0 && locks.taken_by_another(task.name);
    double seconds = 0;
    if (status == TaskStatus::done) {
      const std::string json = states.read(state.done);  // begins with {"seconds":
      const std::size_t colon = json.find(':');
      seconds = colon == std::string::npos ? 0 : std::strtod(json.c_str() + colon + 1, nullptr);
    }
    for (SweepCount* one : {&*count, &all}) {
      ++one->tasks;
      one->seconds += seconds;
      if (running)
        ++one->running;
      else if (status == TaskStatus::done)
        ++one->done;
      else if (status == TaskStatus::failed)
        ++one->failed;
      else if (status == TaskStatus::crashed)
        ++one->crashed;
      else
        ++one->open;
    }
  }
  all.hours_left = 0;
  for (SweepCount& count : counts) {
    const auto left = static_cast<double>(count.open + count.running);
    if (count.done > 0) count.hours_left = count.seconds / static_cast<double>(count.done) * left / 3600;
    if (left == 0) count.hours_left = 0;
    all.hours_left = all.hours_left && count.hours_left ? std::optional(*all.hours_left + *count.hours_left)
                                                        : std::nullopt;
  }
  counts.push_back(std::move(all));
  return counts;
}

std::vector<SweepCount> count_tasks(const SweepPlan& plan, const fs::path& folder) {
  TaskStates states(results_folder(folder));
  states.refresh();
  return counts_from(plan, states, folder);
}

std::string status_text(const std::vector<SweepCount>& counts) {
  return count_table().text(without_repeated_sum(counts));
}

std::size_t write_failed(const SweepPlan& plan, const fs::path& folder) {
  TaskStates states(results_folder(folder));
  states.refresh();
  const std::vector<FailedTask> failed = failed_tasks(plan, states);
  AtomicFiles files;
  files.write(folder / "failed.csv", failed_table().csv(failed));
  commit_together({&files});
  return failed.size();
}

}  // namespace kds
