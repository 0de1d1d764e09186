#pragma once
// The tasks of a sweep, in the order of sweep.json: commands, inputs, options.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/command_line.h"
#include "experiments/sweep/input_files.h"
#include "experiments/sweep/sweep_spec.h"
#include "experiments/sweep/task_name.h"

namespace kds {

struct SweepTask {
  TaskName name = 0;
  std::uint64_t setting = 0;  ///< number of the combination of the block's axes
  std::uint32_t block = 0, input = 0;
  bool is_copy = false;     ///< an earlier task has its name, because their files have the same content
  bool has_copies = false;  ///< another task has its name
};

class SweepPlan {
 public:
  /// Lists the tasks. Reads each input once for its hash, unless `files` remembers it. Takes about
  /// a microsecond for each task. Throws InputError if no task is left, if a task is listed twice, or if an
  /// exclusion without `input` matches no task.
  SweepPlan(SweepSpec spec, InputFiles& files, const std::string& subject);

  [[nodiscard]] const SweepSpec& spec() const { return spec_; }
  [[nodiscard]] const std::vector<SweepTask>& tasks() const { return tasks_; }
  [[nodiscard]] std::size_t excluded() const { return excluded_; }

  [[nodiscard]] const SweepBlock& block(const SweepTask& task) const { return spec_.blocks[task.block]; }
  [[nodiscard]] const SweepInput& input(const SweepTask& task) const {
    return block(task).inputs[task.input];
  }
  /// Returns the value of an axis or of an option of the input, or null if the task has no such option.
  [[nodiscard]] const AxisValue* value(const SweepTask& task, std::string_view axis) const;
  /// Returns `command`, `input` or the text of an axis. Empty if the task has no such axis.
  [[nodiscard]] std::string text(const SweepTask& task, std::string_view axis) const;
  /// Returns the names of the axes of all commands, each once.
  [[nodiscard]] std::vector<std::string> axes() const;
  /// Returns the command and its arguments, with absolute paths, without options of output.
  [[nodiscard]] Arguments arguments(const SweepTask& task) const;
  /// Returns all files that a task reads: its input and those that its options name.
  [[nodiscard]] std::vector<std::string> files(const SweepTask& task) const;
  /// Returns a sentence for each two files of tasks that share their name.
  [[nodiscard]] const std::vector<std::string>& copies() const { return copies_; }

 private:
  void add_tasks(std::uint32_t block, InputFiles& files, const std::string& subject);
  /// Notes which exclusions leave the task out, and returns whether one does.
  [[nodiscard]] bool is_excluded(const SweepTask& task);
  void refuse_idle_exclusions(const std::string& subject) const;
  [[nodiscard]] TaskName name_of(const SweepTask& task, InputFiles& files) const;
  /// Returns option and value of all options that a task is given, sorted by option.
  [[nodiscard]] std::vector<std::pair<std::string, const AxisValue*>> options_of(const SweepTask& task) const;
  /// Marks tasks that share a name. Throws InputError unless their files are equal under two names.
  void mark_copies(const std::string& subject);

  SweepSpec spec_;
  std::vector<SweepTask> tasks_;
  std::size_t excluded_ = 0;
  std::vector<bool> exclusion_matched_;
  std::vector<std::string> copies_;
};

}  // namespace kds
