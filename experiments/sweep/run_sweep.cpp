#include "experiments/sweep/run_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <list>
#include <set>
#include <system_error>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/progress_bar.h"
#include "experiments/sweep/task_journal.h"

namespace kds {

namespace {

using Clock = TaskProcess::Clock;

constexpr double kGrace = 7;         // seconds; less with a short budget
constexpr double kLongAttempt = 60;  // a dropped attempt that ran as long counts, if it had most of the time

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Returns JSON on one line. A line break of indented JSON is never inside a string.
std::string joined_lines(std::string_view json) {
  std::string line;
  for (const std::string& part : split(json, '\n'))
    line.append(part, std::min(part.find_first_not_of(' '), part.size()));
  return line;
}

// The lines that a command wrote to standard error.
struct Messages {
  std::string error;  ///< the last message that is no warning
  Json warnings = Json::array();
};

Messages messages_in(const std::string& err) {
  constexpr std::string_view program = "kds: ", warning = "warning: ";
  constexpr std::size_t longest = 500;
  Messages messages;
  for (const std::string& line : split(err, '\n')) {
    std::string_view words(line);
    if (words.starts_with(program)) words.remove_prefix(program.size());
    if (words.empty()) continue;
    if (words.starts_with(warning))
      messages.warnings.push_back(one_line(words.substr(warning.size(), longest)));
    else
      messages.error = one_line(words.substr(0, longest));
  }
  return messages;
}

// Invalid bytes are replaced.
std::string on_one_line(const Json& json) { return joined_lines(text_of(json)); }

bool sets_threads(const SweepPlan& plan, const SweepTask& task) {
  const AxisValue* const threads = plan.value(task, "threads");
  return threads != nullptr && threads->given;
}

struct RunningTask {
  RunningTask(const SweepTask& of, const std::function<int()>& work, const TaskLimits& limits)
      : task(of), process(work, limits) {}
  const SweepTask& task;
  TaskProcess process;
  bool killed = false;
};

class SweepRun {
 public:
  SweepRun(const SweepPlan& plan, InputFiles& files, const SweepOptions& options, StopSignals& signals)
      : plan_(plan),
        files_(files),
        options_(options),
        signals_(signals),
        bar_(!options.quiet, "task"),
        lock_(*options.out, options.shard),
        states_(results_folder(*options.out)),
        journal_(results_folder(*options.out)),
        grace_(std::min(kGrace, 0.4 * options.time_budget.value_or(kGrace / 0.4))) {}

  SweepOutcome run();

 private:
  void list_open_tasks();
  void start_next();
  void settle(const RunningTask& ended, const TaskProcess::End& end);
  void record(RecordKind kind, const SweepTask& task, const std::string& json = "{}");
  void drop(RunningTask& running);
  [[nodiscard]] bool must_stop();
  [[nodiscard]] bool has_changed_files(const SweepTask& task);
  [[nodiscard]] bool lacks_file(const SweepTask& task) const;
  [[nodiscard]] double next_wait() const;
  [[nodiscard]] SweepOutcome outcome() const;
  [[nodiscard]] TaskStatus status(const SweepTask& task) const { return states_.of(task.name).status(); }

  const SweepPlan& plan_;
  InputFiles& files_;
  const SweepOptions& options_;
  StopSignals& signals_;
  ProgressBar bar_;
  ShardLock lock_;
  TaskStates states_;
  JournalWriter journal_;
  double grace_;                           ///< seconds in which running tasks may end once the sweep stops
  std::optional<Clock::time_point> stop_;  ///< when the sweep began to stop
  std::vector<const SweepTask*> shard_;  ///< all tasks of the shard, without copies if there are other shards
  std::deque<const SweepTask*> open_;    ///< tasks without a result
  std::list<RunningTask> running_;
  bool crowded_ = false;           ///< the system has no more processes until a task ends
  std::set<std::string> changed_;  ///< files, each of which was named in a warning
};

// Tasks that left an attempt without a result come last, so that they hold up no others.
void SweepRun::list_open_tasks() {
  if (options_.retry) states_.forgive();
  const std::vector<SweepTask>& tasks = plan_.tasks();
  for (std::size_t k = options_.shard.number - 1; k < tasks.size(); k += options_.shard.count) {
    const bool is_copy = tasks[k].is_copy;
    if (is_copy && options_.shard.count > 1) continue;  // another shard may run the task
    shard_.push_back(&tasks[k]);
    if (!is_copy && status(tasks[k]) == TaskStatus::open) open_.push_back(&tasks[k]);
  }
  std::ranges::stable_partition(open_,
                                [this](const SweepTask* task) { return states_.of(task->name).lost() == 0; });
}

// A record without room leaves its task open, and so do the tasks that run, if records of a few bytes have
// room.
void SweepRun::record(RecordKind kind, const SweepTask& task, const std::string& json) {
  if (journal_.add(kind, task.name, json)) return states_.count(kind, task.name, json);
  for (const RunningTask& running : running_)
    static_cast<void>(journal_.add(RecordKind::drop, running.task.name));
  throw OutputError(fmt::format(
      "{}: the disk is full and results are not recorded; with more room, the same command continues",
      options_.out->string()));
}

// A task whose files have changed since their hashes were taken would leave its result under the wrong name.
bool SweepRun::has_changed_files(const SweepTask& task) {
  bool changed = false;
  for (const std::string& file : plan_.files(task)) {
    if (!files_.has_changed(file)) continue;
    changed = true;
    if (changed_.insert(file).second)
      print_warning(
          bar_, file + ": changed while the sweep ran; its tasks are left for the same command to run again");
  }
  return changed;
}

// A task whose file is gone has the name of the file's last content. If the task failed for want of the file,
// the failure would remain when the file comes back.
bool SweepRun::lacks_file(const SweepTask& task) const {
  return std::ranges::any_of(plan_.files(task),
                             [this](const std::string& file) { return files_.gone().contains(file); });
}

void SweepRun::start_next() {
  const SweepTask& task = *open_.front();
  open_.pop_front();
  if (lacks_file(task) || has_changed_files(task)) return;
  record(RecordKind::attempt, task);
  try {
    running_.emplace_back(
        task, [&] { return run_arguments(task_arguments(plan_, task)); }, TaskLimits{options_.task_memory});
  } catch (const std::system_error& error) {  // the task starts once another has ended
    record(RecordKind::drop, task);
    if (running_.empty())
      throw TryLater(
          fmt::format("no task can start ({}); the same command continues", error.code().message()));
    open_.push_front(&task);
    crowded_ = true;
  }
}

void SweepRun::settle(const RunningTask& ended, const TaskProcess::End& end) {
  const SweepTask& task = ended.task;
  const Messages messages = messages_in(ended.process.err());
  const auto fail = [&](int code, const std::string& message) {
    record(RecordKind::fail, task,
           on_one_line({{"code", code}, {"error", message}, {"seconds", end.seconds}}));
  };
  crowded_ = false;
  if (has_changed_files(task)) return record(RecordKind::drop, task);
  if (ended.killed && end.signal != 0)
    return fail(1,
                fmt::format("takes more than {} s (--task-seconds)", short_decimal(*options_.task_seconds)));
  if (end.signal != 0) {
    if (options_.task_memory && messages.error.find("annot allocate memory") != std::string::npos)
      return fail(1, "out of memory (--task-memory)");  // GMP aborts
    const char* const name = ::sigdescr_np(end.signal);
    record(RecordKind::died, task,
           on_one_line({{"error", fmt::format("ended by signal {} ({})", end.signal,
                                              name != nullptr ? name : "unknown")}}));
    if (status(task) == TaskStatus::open) open_.push_back(&task);
    return;
  }
  if (end.code != 0)
    return fail(end.code, messages.error.empty() ? fmt::format("exit code {}", end.code) : messages.error);
  const std::string out = joined_lines(ended.process.out());
  if (!out.starts_with('{') || !out.ends_with('}')) return fail(1, "printed no JSON");
  std::string warnings;
  if (!messages.warnings.items()->empty())
    warnings = fmt::format(R"("warnings":{},)", on_one_line(messages.warnings));
  record(RecordKind::done, task,
         fmt::format(R"({{"seconds":{},"processor_seconds":{},{}"result":{}}})", end.seconds,
                     end.processor_seconds, warnings, out));
}

// A dropped attempt does not count. But if it had most of a long sweep for itself, another attempt would be
// dropped too.
void SweepRun::drop(RunningTask& running) {
  const double seconds = running.process.seconds();
  running.process.kill();
  if (seconds >= kLongAttempt && seconds >= 0.5 * seconds_since(options_.begin))
    record(RecordKind::died, running.task,
           on_one_line({{"error", fmt::format("was dropped after {} s at the end of a sweep",
                                              short_decimal(seconds))}}));
  else
    record(RecordKind::drop, running.task);
}

bool SweepRun::must_stop() {
  const bool out_of_time =
      options_.time_budget && seconds_since(options_.begin) >= *options_.time_budget - 1.1 * grace_;
  if (!stop_ && (signals_.stopped() || out_of_time)) stop_ = Clock::now();
  return stop_.has_value();
}

double SweepRun::next_wait() const {
  double seconds = 1;
  const auto until = [&](double end) { seconds = std::min(seconds, std::max(end, 0.0) + 0.001); };
  if (stop_)
    until(grace_ - seconds_since(*stop_));
  else if (options_.time_budget)
    until(*options_.time_budget - 1.1 * grace_ - seconds_since(options_.begin));
  for (const RunningTask& running : running_)
    if (options_.task_seconds && !running.killed) until(*options_.task_seconds - running.process.seconds());
  return seconds;
}

SweepOutcome SweepRun::run() {
  if (!lock_.holds())
    print_warning(bar_,
                  "the file system of the sweep's folder has no locks: do not start a shard twice at a time");
  list_open_tasks();
  std::size_t settled = shard_.size() - open_.size();
  while (true) {
    while (!must_stop() && !crowded_ && running_.size() < options_.jobs.value_or(1) && !open_.empty())
      start_next();
    if (running_.empty() && (stop_ || open_.empty())) break;
    signals_.wait(next_wait());
    for (auto running = running_.begin(); running != running_.end();) {
      if (const auto end = running->process.ended()) {
        settle(*running, *end);
        bar_.update(std::min(++settled, shard_.size()), shard_.size());
        running = running_.erase(running);
        continue;
      }
      if (options_.task_seconds && running->process.seconds() > *options_.task_seconds) {
        running->process.kill();
        running->killed = true;
      }
      ++running;
    }
    if (stop_ && seconds_since(*stop_) > grace_) {
      for (RunningTask& running : running_) drop(running);
      running_.clear();
    }
    journal_.sync(1);
  }
  journal_.sync();
  return outcome();
}

SweepOutcome SweepRun::outcome() const {
  SweepOutcome outcome;
  for (const SweepTask* task : shard_) {
    count_task(states_.of(task->name), false, outcome.count);
    outcome.without_input += status(*task) == TaskStatus::open && lacks_file(*task) ? 1U : 0U;
  }
  return outcome;
}

}  // namespace

SweepOutcome run_sweep(const SweepPlan& plan, InputFiles& files, const SweepOptions& options,
                       StopSignals& signals) {
  return SweepRun(plan, files, options, signals).run();
}

Arguments task_arguments(const SweepPlan& plan, const SweepTask& task) {
  Arguments arguments = plan.arguments(task);
  if (plan.block(task).command->find("threads") != nullptr && !sets_threads(plan, task))
    for (const char* word : {"--threads", "1"}) arguments.emplace_back(word);
  for (const char* word : {"--quiet", "--json", "-"}) arguments.emplace_back(word);
  return arguments;
}

}  // namespace kds
