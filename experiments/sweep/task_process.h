#pragma once
// Runs work in a child process, so that a crash, a time limit or a memory limit ends that work alone. The
// child is a fork: no program is started. The cost of a fork grows with the memory of the process that forks.

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace kds {

struct TaskLimits {
  std::optional<std::uint64_t> memory = {};  ///< bytes of data
};

/// A file in memory that collects what a child writes.
class MemoryFile {
 public:
  /// Throws std::system_error.
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int descriptor() const { return file_; }
  [[nodiscard]] std::string text() const;

 private:
  int file_;
};

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
  /// dies with this process. Throws std::system_error if the system has no more processes or files.
  TaskProcess(const std::function<int()>& work, const TaskLimits& limits);
  /// Ends the child.
  ~TaskProcess();
  TaskProcess(const TaskProcess&) = delete;
  TaskProcess& operator=(const TaskProcess&) = delete;

  [[nodiscard]] double seconds() const;  ///< since the start
  void kill();
  /// Returns how the child ended, or nothing while it runs. Call it no more after it has returned an end.
  [[nodiscard]] std::optional<End> ended() { return collect(true); }
  /// Waits for the end.
  [[nodiscard]] End wait() { return *collect(false); }

  [[nodiscard]] std::string out() const { return out_.text(); }
  [[nodiscard]] std::string err() const { return err_.text(); }

 private:
  [[nodiscard]] std::optional<End> collect(bool at_once);

  MemoryFile out_, err_;
  Clock::time_point start_ = Clock::now();
  pid_t child_ = -1;  ///< -1 once it has ended
};

/// Holds back the signals that ask a program to end (SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU), and
/// SIGCHLD, while it exists. Once a signal has asked, they stay held back: a second one, while the program
/// ends, would take its exit code away.
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
