#pragma once
// The results folder of a sweep: journals of records about tasks. Each running sweep appends to a journal of
// its own, NAME.part, and renames it to NAME.results when it is complete and synced. Readers read both kinds.
//
// A record is a line: a hash of the rest of the line, the kind, the task's name, and JSON. A record counts if
// its hash fits, so a line that was cut off by a crash or a full disk is no record. A killed process loses no
// record, since each is written by one system call; a power failure loses at most those of the last second.
//
//   try    an attempt begins; written before the work
//   drop   the attempt was given up because the sweep had to end; it does not count
//   died   a signal ended the attempt, which left no result
//   fail   the task failed: exit code, message
//   done   the result of the task

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "experiments/sweep/task_name.h"

namespace kds {

enum class RecordKind : std::uint8_t { attempt, drop, died, fail, done };

/// An attempt that leaves no result is repeated until there are this many.
inline constexpr std::uint32_t most_attempts = 2;

/// The place of a record's JSON.
struct RecordPlace {
  std::uint32_t journal = 0, length = 0;  ///< length 0: no record
  std::uint64_t offset = 0;
};

/// The records of a task, counted.
struct TaskState {
  std::uint32_t attempts = 0, closed = 0;  ///< attempts that began; those of them with a result or given up
  bool failed = false;
  RecordPlace done, failure, death;

  [[nodiscard]] bool is_done() const { return done.length > 0; }
  /// Attempts without a result. One of them may be running.
  [[nodiscard]] std::uint32_t lost() const { return attempts > closed ? attempts - closed : 0; }
};

/// Reads the journals of a folder and follows those that grow.
class TaskStates {
 public:
  explicit TaskStates(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Reads what has been appended since the last call.
  void refresh();
  [[nodiscard]] const TaskState& of(TaskName task) const;
  /// Forgets failures and lost attempts of all tasks.
  void forgive();
  /// Returns the JSON text of a record. Throws OutputError if the journal is gone.
  [[nodiscard]] std::string read(const RecordPlace& place) const;
  /// Lines that are no records, apart from the last line of a journal.
  [[nodiscard]] std::size_t damaged() const { return damaged_; }

 private:
  struct Journal {
    std::string stem;
    std::uint64_t read = 0;  ///< bytes
    bool complete = false;   ///< renamed and read to its end
  };
  void read_on(std::uint32_t journal, bool growing);
  void take(std::string_view line, std::uint32_t journal, std::uint64_t offset);
  [[nodiscard]] std::filesystem::path path(const Journal& journal, bool growing) const;

  std::filesystem::path folder_;
  std::vector<Journal> journals_;
  std::unordered_map<std::string, std::uint32_t> by_stem_;
  std::unordered_map<TaskName, TaskState> tasks_;
  std::size_t damaged_ = 0;
};

/// Appends records to a new journal. The file is made with the first record.
class JournalWriter {
 public:
  explicit JournalWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// Returns false if the disk has no room for the record, of which nothing remains then. `json` is one line.
  /// Throws OutputError if the record cannot be written for another reason.
  [[nodiscard]] bool add(RecordKind kind, TaskName task, std::string_view json = "{}");
  /// Syncs the journal if a record has waited for a second.
  void sync_now_and_then();
  /// Syncs the journal and renames it. The next record begins another journal.
  void complete();

 private:
  using Clock = std::chrono::steady_clock;
  void open();
  void sync();

  std::filesystem::path folder_, growing_;
  std::uint64_t size_ = 0;
  int file_ = -1;
  bool waits_ = false;
  Clock::time_point since_;
};

/// Claims tasks between sweeps that work in one folder at once: record locks on one byte of the file `locks`
/// for each task. The system drops the locks of a process that ends, however it ends. The folder may be on a
/// shared file system that has such locks: NFS, GPFS, Lustre mounted with `flock`.
class TaskLocks {
 public:
  enum class Use : std::uint8_t { take, look };
  /// Opens the file. To take locks, makes it if needed, and throws OutputError if it cannot be written. To
  /// look at the locks of others, takes none to exist if the file cannot be read.
  explicit TaskLocks(const std::filesystem::path& file, Use use = Use::take);
  ~TaskLocks();
  TaskLocks(const TaskLocks&) = delete;
  TaskLocks& operator=(const TaskLocks&) = delete;

  /// Returns false if another process has the task. Always succeeds if the file system has no locks.
  [[nodiscard]] bool take(TaskName task);
  void release(TaskName task);
  [[nodiscard]] bool taken_by_another(TaskName task) const;
  [[nodiscard]] bool supported() const { return supported_; }

 private:
  int file_ = -1;
  bool supported_ = true;
};

}  // namespace kds
