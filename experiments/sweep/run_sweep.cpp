#include "experiments/sweep/run_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <list>
#include <set>
#include <unordered_set>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/sweep/swept_task.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

using Clock = TaskProcess::Clock;

constexpr double kGrace = 7;         // seconds; less with a short budget
constexpr double kLongAttempt = 60;  // a dropped attempt that ran as long counts, if it had most of the time
constexpr std::size_t kMostClaimed = 256;
// If this many results in turn have no room, the disk is taken to be full.
constexpr std::size_t kMostWithoutRoom = 3;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct RunningTask {
  const SweepTask* task;
  std::uint64_t id;
  TaskOutput output;
  Clock::time_point start = Clock::now();
  bool killed = false;
};

class SweepRun {
 public:
  SweepRun(const SweepPlan& plan, InputHashes& hashes, const fs::path& folder, const SweepLimits& limits,
           TaskLauncher& launcher, StopSignals& signals, const std::function<void(const std::string&)>& warn)
      : plan_(plan),
        hashes_(hashes),
        folder_(folder),
        limits_(limits),
        launcher_(launcher),
        signals_(signals),
        warn_(warn),
        states_(results_folder(folder)),
        journal_(results_folder(folder)),
        locks_(locks_file(folder)),
        grace_(std::min(kGrace, 0.4 * limits.budget.value_or(kGrace / 0.4))) {}

  SweepOutcome run(const std::function<void(std::size_t, std::size_t)>& progress);

 private:
  void list_open_tasks();
  void claim();
  void start(const SweepTask& task);
  void start_later(const RunningTask& unstarted, int error);
  void settle(const RunningTask& ended, const TaskProcess::End& end);
  void record(RecordKind kind, const SweepTask& task, const std::string& json);
  void fail(const SweepTask& task, int code, const std::string& message, double seconds);
  void drop(const RunningTask& running);
  [[noreturn]] void refuse_full_disk() const;
  [[nodiscard]] bool must_stop();
  [[nodiscard]] bool has_changed_files(const SweepTask& task);
  [[nodiscard]] bool lacks_file(const SweepTask& task) const;
  [[nodiscard]] double next_wait() const;
  [[nodiscard]] bool is_open(const SweepTask& task) const {
    return status_of(states_.of(task.name)) == TaskStatus::open;
  }

  const SweepPlan& plan_;
  InputHashes& hashes_;
  const fs::path& folder_;
  const SweepLimits& limits_;
  TaskLauncher& launcher_;
  StopSignals& signals_;
  const std::function<void(const std::string&)>& warn_;
  TaskStates states_;
  JournalWriter journal_;
  TaskLocks locks_;
  double grace_;                            ///< seconds in which running tasks may end once the sweep stops
  std::optional<Clock::time_point> stop_;   ///< when the sweep began to stop
  std::vector<const SweepTask*> shard_;     ///< all tasks of the shard
  std::deque<const SweepTask*> unclaimed_;  ///< tasks without a result
  std::deque<const SweepTask*> elsewhere_;  ///< tasks that another sweep had locked at the last look
  std::deque<const SweepTask*> claimed_;    ///< with their locks
  std::list<RunningTask> running_;
  std::uint64_t next_id_ = 0;
  bool crowded_ = false;           ///< the system has no more processes until a task ends
  std::set<std::string> changed_;  ///< files, each of which was named in a warning
  std::size_t without_room_ = 0, without_room_in_turn_ = 0;
  double task_seconds_ = 0;  ///< of all attempts that ended
  Clock::time_point looked_elsewhere_ = Clock::now();
  SweepOutcome outcome_;
};

// Tasks that left an attempt without a result come last, so that they hold up no others.
void SweepRun::list_open_tasks() {
  states_.refresh();
  if (limits_.retry) states_.forgive();
  std::vector<const SweepTask*> tried;
  std::unordered_set<TaskName> listed;  // equal files under two names are one task
  const std::vector<SweepTask>& tasks = plan_.tasks();
  for (std::size_t k = limits_.shard.number - 1; k < tasks.size(); k += limits_.shard.count) {
    shard_.push_back(&tasks[k]);
    if (!is_open(tasks[k]) || !listed.insert(tasks[k].name).second) continue;
    if (states_.of(tasks[k].name).lost() > 0)
      tried.push_back(&tasks[k]);
    else
      unclaimed_.push_back(&tasks[k]);
  }
  unclaimed_.insert(unclaimed_.end(), tried.begin(), tried.end());
}

// Claims about a tenth of a second of work for each job. A task runs only if it still has no result once it
// is locked.
void SweepRun::claim() {
  if (unclaimed_.empty() && !elsewhere_.empty() && seconds_since(looked_elsewhere_) >= 0.2) {
    unclaimed_.swap(elsewhere_);
    looked_elsewhere_ = Clock::now();
  }
  const double mean = outcome_.ran > 0 ? task_seconds_ / static_cast<double>(outcome_.ran) : 1;
  const double wanted = 0.1 / std::max(mean, 1e-6) * static_cast<double>(limits_.jobs);
  const std::size_t most =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::min(wanted, 1e6)), 1, kMostClaimed);
  std::vector<const SweepTask*> locked;
  while (locked.size() < most && !unclaimed_.empty()) {
    const SweepTask* const task = unclaimed_.front();
    unclaimed_.pop_front();
    if (locks_.take(task->name))
      locked.push_back(task);
    else
      elsewhere_.push_back(task);
  }
  if (locked.empty()) return;
  states_.refresh();
  for (const SweepTask* task : locked) {
    if (is_open(*task))
      claimed_.push_back(task);
    else
      locks_.release(task->name);
  }
}

// A result without room leaves its task open. Other results may be smaller, so the sweep goes on for a while.
void SweepRun::record(RecordKind kind, const SweepTask& task, const std::string& json) {
  if (journal_.add(kind, task.name, json)) {
    if (kind == RecordKind::done) without_room_in_turn_ = 0;
    return;
  }
  ++without_room_;
  const bool goes_on = kind == RecordKind::done && ++without_room_in_turn_ < kMostWithoutRoom;
  if (!goes_on || !journal_.add(RecordKind::drop, task.name)) refuse_full_disk();
}

void SweepRun::refuse_full_disk() const {
  throw OutputError(
      fmt::format("{}: the disk is full, {} {} not recorded; with more room, the same command continues",
                  folder_.string(), without_room_, without_room_ == 1 ? "result was" : "results were"));
}

// A task whose files have changed since their hashes were taken would leave its result under the wrong name.
bool SweepRun::has_changed_files(const SweepTask& task) {
  bool changed = false;
  for (const std::string& file : plan_.files(task)) {
    if (!hashes_.has_changed(file)) continue;
    changed = true;
    if (changed_.insert(file).second)
      warn_(file + ": changed while the sweep ran; its tasks are left for the same command to run again");
  }
  return changed;
}

// A task whose file is gone has the name of the file's last content. If the task failed for want of the file,
// the failure would remain when the file comes back.
bool SweepRun::lacks_file(const SweepTask& task) const {
  return std::ranges::any_of(plan_.files(task),
                             [this](const std::string& file) { return hashes_.is_gone(file); });
}

void SweepRun::start(const SweepTask& task) {
  if (lacks_file(task) || has_changed_files(task)) return locks_.release(task.name);
  record(RecordKind::attempt, task, "{}");
  running_.push_back({&task, next_id_++, TaskOutput()});
  const RunningTask& started = running_.back();
  launcher_.start(started.id, task_arguments(plan_, task), {limits_.task_memory, !sets_threads(plan_, task)},
                  started.output);
}

// The system has no more processes: the task starts again once another has ended.
void SweepRun::start_later(const RunningTask& unstarted, int error) {
  record(RecordKind::drop, *unstarted.task, "{}");
  if (running_.size() == 1) throw OutputError(fmt::format("no task can start: {}", std::strerror(error)));
  claimed_.push_front(unstarted.task);
  crowded_ = true;
}

void SweepRun::fail(const SweepTask& task, int code, const std::string& message, double seconds) {
  record(RecordKind::fail, task, failure_json(code, message, seconds));
}

void SweepRun::settle(const RunningTask& ended, const TaskProcess::End& end) {
  const SweepTask& task = *ended.task;
  ++outcome_.ran;
  crowded_ = false;
  task_seconds_ += end.seconds;
  if (has_changed_files(task)) {
    record(RecordKind::drop, task, "{}");
  } else if (end.signal == 0 && end.code == 0) {
    const std::string out = joined_lines(ended.output.out());
    if (out.starts_with('{') && out.ends_with('}'))
      record(RecordKind::done, task,
             fmt::format(R"({{"seconds":{},"processor_seconds":{},"result":{}}})", end.seconds,
                         end.processor_seconds, out));
    else
      fail(task, 1, "printed no JSON", end.seconds);
  } else if (end.signal == 0) {
    const std::string message = message_of(ended.output.err());
    fail(task, end.code, message.empty() ? fmt::format("exit code {}", end.code) : message, end.seconds);
  } else if (ended.killed) {
    fail(task, 1, fmt::format("takes more than {} s (--task-seconds)", short_decimal(*limits_.task_seconds)),
         end.seconds);
  } else if (limits_.task_memory && ended.output.err().find("annot allocate memory") != std::string::npos) {
    fail(task, 1, "out of memory (--task-memory)", end.seconds);  // GMP aborts
  } else {
    record(RecordKind::died, task, fmt::format(R"({{"error":"ended by {}"}})", signal_text(end.signal)));
    unclaimed_.push_back(&task);
  }
  locks_.release(task.name);
}

// A dropped attempt does not count. But if it had most of a long sweep for itself, another attempt would be
// dropped too.
void SweepRun::drop(const RunningTask& running) {
  const double seconds = seconds_since(running.start);
  launcher_.kill(running.id);
  const bool counts = seconds >= kLongAttempt && seconds >= 0.5 * seconds_since(limits_.begin);
  if (counts)
    record(
        RecordKind::died, *running.task,
        fmt::format(R"({{"error":"was dropped after {} s at the end of a sweep"}})", short_decimal(seconds)));
  else
    record(RecordKind::drop, *running.task, "{}");
  locks_.release(running.task->name);
  ++outcome_.dropped;
}

bool SweepRun::must_stop() {
  const bool out_of_time = limits_.budget && seconds_since(limits_.begin) >= *limits_.budget - 1.1 * grace_;
  if (!stop_ && (signals_.stopped() || out_of_time)) stop_ = Clock::now();
  return stop_.has_value();
}

double SweepRun::next_wait() const {
  double seconds = running_.empty() ? 0.2 : 1;
  const auto until = [&](double end) { seconds = std::min(seconds, std::max(end, 0.0) + 0.001); };
  if (stop_)
    until(grace_ - seconds_since(*stop_));
  else if (limits_.budget)
    until(*limits_.budget - 1.1 * grace_ - seconds_since(limits_.begin));
  for (const RunningTask& running : running_)
    if (limits_.task_seconds) until(*limits_.task_seconds - seconds_since(running.start));
  return seconds;
}

SweepOutcome SweepRun::run(const std::function<void(std::size_t, std::size_t)>& progress) {
  list_open_tasks();
  std::size_t settled = shard_.size() - unclaimed_.size();
  while (true) {
    const bool stopping = must_stop();
    while (!stopping && !crowded_ && running_.size() < limits_.jobs) {
      if (claimed_.empty()) claim();
      if (claimed_.empty()) break;
      const SweepTask* const next = claimed_.front();
      claimed_.pop_front();
      start(*next);
    }
    if (running_.empty() && (stopping || (claimed_.empty() && unclaimed_.empty() && elsewhere_.empty())))
      break;
    if (!running_.empty() || !elsewhere_.empty()) signals_.wait(next_wait());
    for (RunningTask& running : running_) {
      if (running.killed || !limits_.task_seconds || seconds_since(running.start) <= *limits_.task_seconds)
        continue;
      launcher_.kill(running.id);
      running.killed = true;
    }
    for (const TaskLauncher::Ended& ended : launcher_.ended()) {
      const auto running = std::ranges::find(running_, ended.id, &RunningTask::id);
      if (running == running_.end()) continue;
      if (ended.error != 0) {
        start_later(*running, ended.error);
      } else {
        settle(*running, ended.end);
        progress(std::min(++settled, shard_.size()), shard_.size());
      }
      running_.erase(running);
    }
    if (stop_ && seconds_since(*stop_) > grace_) {
      for (const RunningTask& running : running_) drop(running);
      running_.clear();
    }
    journal_.sync_now_and_then();
  }
  journal_.complete();
  if (without_room_ > 0) refuse_full_disk();
  if (!locks_.supported())
    warn_("the file system of the sweep's folder has no locks: give each sweep on it a --shard of its own");
  states_.refresh();
  for (const SweepTask* task : shard_) {
    const TaskStatus status = status_of(states_.of(task->name));
    outcome_.done += status == TaskStatus::done ? 1U : 0U;
    outcome_.failed += status == TaskStatus::failed ? 1U : 0U;
    outcome_.crashed += status == TaskStatus::crashed ? 1U : 0U;
    outcome_.without_input += status == TaskStatus::open && lacks_file(*task) ? 1U : 0U;
  }
  outcome_.tasks = shard_.size();
  outcome_.stopped =
      outcome_.done + outcome_.failed + outcome_.crashed + outcome_.without_input < shard_.size();
  return outcome_;
}

}  // namespace

TaskStatus status_of(const TaskState& state) {
  if (state.is_done()) return TaskStatus::done;
  if (state.failed) return TaskStatus::failed;
  return state.lost() >= most_attempts ? TaskStatus::crashed : TaskStatus::open;
}

fs::path results_folder(const fs::path& sweep) { return sweep / "results"; }
fs::path locks_file(const fs::path& sweep) { return sweep / "locks"; }

SweepOutcome run_sweep(const SweepPlan& plan, InputHashes& hashes, const fs::path& folder,
                       const SweepLimits& limits, TaskLauncher& launcher, StopSignals& signals,
                       const std::function<void(std::size_t, std::size_t)>& progress,
                       const std::function<void(const std::string&)>& warn) {
  return SweepRun(plan, hashes, folder, limits, launcher, signals, warn).run(progress);
}

}  // namespace kds
