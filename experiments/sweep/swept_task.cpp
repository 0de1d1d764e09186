#include "experiments/sweep/swept_task.h"

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <optional>

#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"

namespace kds {

std::string joined_lines(std::string_view json) {
  std::string line;
  line.reserve(json.size());
  for (std::size_t k = 0; k < json.size(); ++k) {
    if (json[k] != '\n') {
      line += json[k];
      continue;
    }
    while (k + 1 < json.size() && json[k + 1] == ' ') ++k;
  }
  return line;
}

std::string message_of(const std::string& err) {
  constexpr std::string_view program = "kds: ", warning = "warning: ";
  std::string message;
  for (const std::string& line : split(err, '\n')) {
    std::string_view words(line);
    if (words.starts_with(program)) words.remove_prefix(program.size());
    if (!words.empty() && !words.starts_with(warning)) message = words;
  }
  constexpr std::size_t longest = 500;
  return one_line(message.substr(0, longest));
}

std::string signal_text(int signal) {
  const char* const name = ::sigdescr_np(signal);
  return fmt::format("signal {} ({})", signal, name != nullptr ? name : "unknown");
}

std::string failure_json(int code, const std::string& message, double seconds) {
  const Json json{{"code", code}, {"error", message}, {"seconds", seconds}};
  return line_of(json).value_or(R"({"code":1,"error":"the message is not UTF-8"})");
}

bool sets_threads(const SweepPlan& plan, const SweepTask& task) {
  const AxisValue* const threads = plan.value(task, "threads");
  return threads != nullptr && threads->given;
}

Arguments task_arguments(const SweepPlan& plan, const SweepTask& task) {
  Arguments arguments = plan.arguments(task);
  if (plan.block(task).command->find("threads") != nullptr && !sets_threads(plan, task))
    for (const char* word : {"--threads", "1"}) arguments.emplace_back(word);
  for (const char* word : {"--quiet", "--json", "-"}) arguments.emplace_back(word);
  return arguments;
}

TrialRun try_task(const SweepPlan& plan, const SweepTask& task, double most_seconds, StopSignals& signals) {
  TaskProcess process([&] { return run_arguments(task_arguments(plan, task)); },
                      {std::nullopt, !sets_threads(plan, task)});
  TrialRun run;
  std::optional<TaskProcess::End> end;
  while (!(end = process.ended())) {
    if (signals.stopped()) throw SweepStopped{};
    run.cut_off =
        std::chrono::duration<double>(TaskProcess::Clock::now() - process.start()).count() > most_seconds;
    if (run.cut_off) process.kill();
    signals.wait(0.1);
  }
  run.seconds = end->seconds;
  if (!run.cut_off && (end->signal != 0 || end->code != 0)) {
    run.error = message_of(process.output().err());
    if (run.error.empty()) run.error = end->signal != 0 ? "ended by " + signal_text(end->signal) : "failed";
  }
  return run;
}

}  // namespace kds
