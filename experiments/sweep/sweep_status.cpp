#include "experiments/sweep/sweep_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "experiments/output/text.h"

namespace kds {

namespace {

std::span<const SweepCount> without_repeated_sum(const std::vector<SweepCount>& counts) {
  return std::span(counts).first(counts.size() - (counts.size() == 2 ? 1 : 0));
}

Table<SweepCount> count_table() {
  using R = SweepCount;
  return {{
      {"command", "command", [](const R& r) { return Field(r.command); }},
      {"tasks", "tasks", [](const R& r) { return Field(r.tasks); }},
      {"done", "done", [](const R& r) { return Field(r.done); }},
      {"warned", "with warnings", [](const R& r) { return Field(r.warned); }},
      {"failed", "failed", [](const R& r) { return Field(r.failed); }},
      {"crashed", "crashed", [](const R& r) { return Field(r.crashed); }},
      {"open", "open", [](const R& r) { return Field(r.open); }},
      {.key = "seconds",
       .heading = "seconds of tasks done",
       .value = [](const R& r) { return Field(r.seconds); },
       .format = shortly},
      {.key = "left",
       .heading = "core hours left",
       .value = [](const R& r) { return Field(r.hours_left); },
       .format = shortly},
  }};
}

}  // namespace

void count_task(const TaskState& state, bool running, SweepCount& count) {
  TaskStatus status = state.status();
  if (running && state.lost() > state.died && status == TaskStatus::crashed) status = TaskStatus::open;
  ++count.tasks;
  ++(status == TaskStatus::done     ? count.done
     : status == TaskStatus::failed ? count.failed
     : status == TaskStatus::open   ? count.open
                                    : count.crashed);
  count.warned += state.warned ? 1U : 0U;
  count.seconds += static_cast<double>(state.seconds);
}

std::vector<SweepCount> count_tasks(const SweepPlan& plan, const TaskStates& states, bool running) {
  std::vector<SweepCount> counts;
  SweepCount all;
  all.command = "all";
  for (const SweepTask& task : plan.tasks()) {
    const std::string& command = plan.block(task).command->name;
    auto own = std::ranges::find(counts, command, &SweepCount::command);
    if (own == counts.end()) own = counts.insert(own, {command});
    for (SweepCount* one : {&*own, &all}) count_task(states.of(task.name), running, *one);
  }
  for (SweepCount& count : counts) {
    if (count.open == 0) continue;
    count.hours_left.reset();
    if (count.done > 0)
      count.hours_left =
          count.seconds / static_cast<double>(count.done) * static_cast<double>(count.open) / 3600;
    all.hours_left = all.hours_left && count.hours_left ? std::optional(*all.hours_left + *count.hours_left)
                                                        : std::nullopt;
  }
  counts.push_back(std::move(all));
  return counts;
}

std::string counts_text(const std::vector<SweepCount>& counts) {
  return count_table().text(without_repeated_sum(counts));
}

std::string other_versions_text(const TaskStates& states) {
  std::string text;
  for (const auto& [version, results] : states.of_other_versions())
    text += fmt::format("{} {} to version {} of kds, which collects them\n", with_thousands(results),
                        results == 1 ? "result belongs" : "results belong", version);
  return text;
}

TaskMessage message_of(const SweepPlan& plan, const SweepTask& task, std::string message) {
  return {hex_digits(task.name),    plan.text(task, "command"),
          plan.text(task, "input"), "",
          std::move(message),       "kds " + shell_words(plan.arguments(task))};
}

std::optional<TaskMessage> failure_of(const SweepPlan& plan, const SweepTask& task,
                                      const TaskStates& states) {
  const TaskState& state = states.of(task.name);
  const TaskStatus status = state.status();
  if (status != TaskStatus::failed && status != TaskStatus::crashed) return std::nullopt;
  const Json json = states.read(state.span);
  const Json *const error = json.find("error"), *const code = json.find("code");
  TaskMessage failure = message_of(
      plan, task, error != nullptr && error->text() != nullptr ? *error->text() : "the sweep was killed");
  failure.status = status == TaskStatus::failed ? "failed" : "crashed";
  if (status == TaskStatus::crashed)
    failure.message = fmt::format("{} attempts left no result; the last {}", state.lost(), failure.message);
  if (code != nullptr && code->whole_number() != nullptr) failure.code = *code->whole_number();
  return failure;
}

Table<TaskMessage> message_table(bool of_failures) {
  using R = TaskMessage;
  Table<R> table{{{"task", "task", [](const R& r) { return Field(r.task); }},
                  {"command", "command", [](const R& r) { return Field(r.command); }},
                  {"input", "input", [](const R& r) { return text_or_nothing(r.input); }}}};
  if (of_failures)
    table.add({{"status", "status", [](const R& r) { return Field(r.status); }},
               {"code", "", [](const R& r) { return r.code > 0 ? Field(r.code) : Field(); }}});
  const char* const message = of_failures ? "error" : "warning";
  return table.add({{message, message, [](const R& r) { return Field(r.message); }},
                    {"repeat", "repeat", [](const R& r) { return Field(r.repeat); }}});
}

}  // namespace kds
