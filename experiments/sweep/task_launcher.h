#pragma once
// Starts tasks from a process that stays small. The cost of a fork grows with the memory of the process that
// forks, so the launcher is made before a sweep reads its plan, and receives the arguments of each task.

#include <sys/types.h>

#include <cstdint>
#include <vector>

#include "experiments/program/command_line.h"
#include "experiments/sweep/task_process.h"

namespace kds {

class TaskLauncher {
 public:
  struct Ended {
    std::uint64_t id = 0;
    TaskProcess::End end;
    int error = 0;  ///< errno if the task could not be started; it may start later
  };

  /// Forks the launcher. Throws std::system_error.
  TaskLauncher();
  /// Ends the launcher and its tasks.
  ~TaskLauncher();
  TaskLauncher(const TaskLauncher&) = delete;
  TaskLauncher& operator=(const TaskLauncher&) = delete;

  /// Starts the command that `arguments` name, as a task with this number. Its output goes to `output`.
  /// Throws OutputError if the launcher has ended.
  void start(std::uint64_t id, const Arguments& arguments, const TaskLimits& limits,
             const TaskOutput& output);
  void kill(std::uint64_t id);
  /// Returns the tasks that have ended since the last call. SIGCHLD tells that there are some. Throws
  /// OutputError if the launcher has ended.
  [[nodiscard]] std::vector<Ended> ended();

 private:
  void send(std::uint64_t id, const TaskLimits& limits, const Arguments* arguments, const TaskOutput* output);

  int socket_ = -1;
  pid_t launcher_ = -1;
};

}  // namespace kds
