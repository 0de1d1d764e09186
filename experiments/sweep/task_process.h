#pragma once
// Runs work in a child process, so that a crash, a time limit or a memory limit ends that work alone. The
// child is a fork: no program is started. The cost of a fork grows with the memory of the process, from about
// a third of a millisecond (task_launcher.h).

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace kds {

struct TaskLimits {
  std::optional<std::uint64_t> memory = {};  ///< bytes of data
  bool one_thread = true;                    ///< for work that does not say its number of threads itself
};

/// The output of a child, which waits in memory.
class TaskOutput {
 public:
  /// Makes two files in memory. Throws std::system_error.
  TaskOutput();
  /// Takes two open descriptors.
  TaskOutput(int out, int err) : out_(out), err_(err) {}
  ~TaskOutput();
  TaskOutput(TaskOutput&& other) noexcept;
  TaskOutput& operator=(TaskOutput&& other) noexcept;

  [[nodiscard]] int out_file() const { return out_; }
  [[nodiscard]] int err_file() const { return err_; }
  /// Returns what the child wrote on standard output, or on standard error.
  [[nodiscard]] std::string out() const;
  [[nodiscard]] std::string err() const;

 private:
  int out_ = -1, err_ = -1;
};

/// Returns how many tasks can run at a time: each of them takes two descriptors of the sweep (ulimit -n).
[[nodiscard]] std::size_t most_tasks_at_once();

/// Makes this process ignore the signals that ask a program to end.
void ignore_stop_signals();

/// A child process.
class TaskProcess {
 public:
  using Clock = std::chrono::steady_clock;
  /// How a child ended.
  struct End {
    int code = 0;    ///< exit code, unless a signal ended the child
    int signal = 0;  ///< 0 if the child exited
    double seconds = 0, processor_seconds = 0;
  };

  /// Starts `work`, whose result is the exit code. The child ignores signals that ask a program to end, and
  /// dies with this process. No thread of oneTBB may have started before. Throws std::system_error if the
  /// system has no more processes.
  TaskProcess(const std::function<int()>& work, const TaskLimits& limits, TaskOutput output = {});
  ~TaskProcess();
  TaskProcess(TaskProcess&& other) noexcept;
  TaskProcess& operator=(TaskProcess&&) = delete;

  [[nodiscard]] Clock::time_point start() const { return start_; }
  void kill();
  /// Returns how the child ended, or nothing while it runs.
  [[nodiscard]] std::optional<End> ended();
  /// Waits for the end.
  [[nodiscard]] End wait();

  [[nodiscard]] const TaskOutput& output() const { return output_; }

 private:
  [[nodiscard]] std::optional<End> collect(int options);

  pid_t child_ = -1;  ///< -1 once it has ended
  TaskOutput output_;
  Clock::time_point start_ = Clock::now();
};

/// Holds back the signals that ask a program to end (SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU), and
/// SIGCHLD, while it exists.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Waits until a signal comes or a child ends, at most so long.
  void wait(double seconds);
  /// Returns whether a signal has asked the program to end.
  [[nodiscard]] bool stopped() {
    wait(0);
    return stopped_;
  }

 private:
  sigset_t held_{}, before_{};
  bool stopped_ = false;
};

}  // namespace kds
