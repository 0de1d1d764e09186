#pragma once
// The results folder of a sweep: journals of records about tasks. Each running sweep appends to a journal of
// its own. Several sweeps never write to one file.
//
// A record is a line: a hash of the rest of the line, the kind, the task's name, and JSON. A record counts if
// its hash fits, so a line that was cut off by a crash or a full disk is no record. A killed process loses no
// record, since each is written by one system call; a power failure loses at most those of the last second.
//
//   made   the first record: the hash of the sources (results_version.h) in place of a task, and the version
//   try    an attempt begins; written before the work
//   drop   the attempt was given up because the sweep had to end; it does not count
//   died   a signal ended the attempt, which left no result
//   fail   the task failed: exit code, message
//   done   the result of the task

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/sweep/results_version.h"
#include "experiments/sweep/task_name.h"

namespace kds {

enum class RecordKind : std::uint8_t { made, attempt, drop, died, fail, done };
/// The states of a task. A task that two attempts have left without a result is crashed.
enum class TaskStatus : std::uint8_t { open, done, failed, crashed };

/// An attempt that leaves no result is repeated until there are this many.
inline constexpr std::uint32_t most_attempts = 2;

/// The position of the JSON of a record: the journal, the first byte and the length.
struct RecordSpan {
  std::uint32_t journal = 0, length = 0;  ///< length 0: no record
  std::uint64_t offset = 0;
};

/// The records of a task, counted.
struct TaskState {
  std::uint32_t attempts = 0, closed = 0;  ///< attempts that began; those of them with a result or given up
  std::uint32_t died = 0;
  float seconds = 0;                      ///< of the attempt with the result
  TaskStatus settled = TaskStatus::open;  ///< done or failed, otherwise open
  bool warned = false;                    ///< the record of the result has warnings
  RecordSpan span;  ///< of the result, otherwise of the last failure, otherwise of the last death

  /// Attempts without a result. One of them may be running.
  [[nodiscard]] std::uint32_t lost() const { return attempts > closed ? attempts - closed : 0; }
  [[nodiscard]] TaskStatus status() const {
    const bool crashed = settled == TaskStatus::open && lost() >= most_attempts;
    return crashed ? TaskStatus::crashed : settled;
  }
};

/// The version of kds that wrote a journal.
struct JournalMaker {
  std::uint64_t sources = results_version();
  std::string version = program_version();
};

/// The states of all tasks with records, about 70 bytes each.
class TaskStates {
 public:
  /// Reads all journals of a folder.
  explicit TaskStates(const std::filesystem::path& folder);

  [[nodiscard]] const TaskState& of(TaskName task) const;
  /// Counts a record that this process has written.
  void count(RecordKind kind, TaskName task, std::string_view json, const RecordSpan& span = {});
  /// Forgets failures and lost attempts of all tasks.
  void forgive();
  /// Returns the JSON of a record. Throws OutputError if the journal is gone.
  [[nodiscard]] Json read(const RecordSpan& span) const;
  /// Returns the number of results for each other version of kds, by its name.
  [[nodiscard]] std::map<std::string, std::size_t> of_other_versions() const;
  /// Lines that are no records, apart from the last line of a journal.
  [[nodiscard]] std::size_t damaged() const { return damaged_; }

 private:
  struct Journal {
    std::filesystem::path file;
    JournalMaker maker;
  };
  void take(std::string_view line, std::uint64_t offset);

  std::vector<Journal> journals_;
  std::unordered_map<TaskName, TaskState> tasks_;
  std::size_t damaged_ = 0;
};

/// Appends records to a new journal. The file is made with the first record.
class JournalWriter {
 public:
  explicit JournalWriter(std::filesystem::path folder, JournalMaker maker = {})
      : folder_(std::move(folder)), maker_(std::move(maker)) {}
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// Returns false if the disk has no room for the record, of which nothing remains then. `json` is one line.
  /// Throws OutputError if the record cannot be written for another reason.
  [[nodiscard]] bool add(RecordKind kind, TaskName task, std::string_view json = "{}");
  /// Syncs the journal if a record has waited for so many seconds.
  void sync(double seconds = 0);

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path folder_, path_;
  JournalMaker maker_;
  std::uint64_t size_ = 0;
  int file_ = -1;
  bool waits_ = false;
  Clock::time_point since_;
};

}  // namespace kds
