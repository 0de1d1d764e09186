#pragma once
// The folder of a sweep: the sweep itself in plan.json, journals in results/, and locks that refuse a second
// process of one shard.

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "experiments/output/result_json.h"
#include "experiments/sweep/input_files.h"

namespace kds {

/// The sweep cannot go on now; the same command continues later. The program exits with code 75.
class TryLater : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Shard `number` of `count`, counted from 1: tasks number - 1, number - 1 + count, ... of the plan.
struct Shard {
  std::size_t number = 1, count = 1;
};

/// Lets one process run a shard, and refuses shards of another number, because these would share tasks.
/// POSIX record locks on the file `lock` do so, also between machines that share the folder (NFS, GPFS,
/// Lustre mounted with `flock`). The system drops the locks of a process that ends, however it ends.
class ShardLock {
 public:
  /// Throws TryLater if another process runs the shard, or shards of another number. Throws OutputError if
  /// the file cannot be written.
  ShardLock(const std::filesystem::path& folder, const Shard& shard);
  ~ShardLock();
  ShardLock(const ShardLock&) = delete;
  ShardLock& operator=(const ShardLock&) = delete;

  /// Returns false if the file system has no locks.
  [[nodiscard]] bool holds() const { return holds_; }
  /// Returns whether another process runs a shard in this folder.
  [[nodiscard]] static bool taken(const std::filesystem::path& folder);

 private:
  int file_ = -1;
  bool holds_ = true;
};

struct KeptPlan {
  Json sweep;                      ///< the content of SWEEP.json
  std::filesystem::path relative;  ///< the folder from which relative paths lead
  Json inputs;                     ///< InputFiles::json
  std::string subject;             ///< the path of plan.json, for messages
};

/// The folder of journals.
[[nodiscard]] std::filesystem::path results_folder(const std::filesystem::path& sweep);
/// Returns the content of SWEEP.json. Throws InputError if it cannot be read.
[[nodiscard]] std::string text_of_sweep(const std::filesystem::path& file);
/// Throws InputError unless the folder is that of a sweep, or is empty, or does not exist.
void check_sweep_folder(const std::filesystem::path& folder);
/// Makes the folder and writes plan.json, unless it has that content. Throws InputError or OutputError.
void keep_plan(const std::filesystem::path& folder, const Json& sweep, const std::filesystem::path& relative,
               const InputFiles& inputs);
/// Returns an empty plan if the folder has no plan.json.
[[nodiscard]] KeptPlan kept_plan(const std::filesystem::path& folder);

}  // namespace kds
