#include "experiments/sweep/sweep_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "experiments/output/output_files.h"
#include "experiments/sweep/refuse.h"
#include "motions/base/input_file.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPlan = "plan.json", kLock = "lock";

// Bytes of the file of locks. Each process shares the byte of its number of shards, and owns that of its
// shard.
constexpr off_t kShards = off_t{1} << 40U, kAll = 0;

struct flock lock_on(short type, off_t first, off_t bytes) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = first;
  lock.l_len = bytes;  // 0: to the end
  return lock;
}

// Returns whether another process has a lock on these bytes.
bool is_taken(int file, off_t first, off_t bytes) {
  struct flock lock = lock_on(F_WRLCK, first, bytes);
  return ::fcntl(file, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

// Returns 0, or errno if there is no such lock to be had.
int take(int file, short type, off_t byte) {
  struct flock lock = lock_on(type, byte, 1);
  while (::fcntl(file, F_SETLK, &lock) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

}  // namespace

ShardLock::ShardLock(const fs::path& folder, const Shard& shard)
    : file_(::open((folder / kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail_to_write((folder / kLock).string(), errno);
  const auto count = static_cast<off_t>(shard.count), number = static_cast<off_t>(shard.number);
  const int of_count = take(file_, F_RDLCK, count), of_shard = take(file_, F_WRLCK, kShards + number);
  const auto is_refusal = [](int error) { return error == EAGAIN || error == EACCES; };
  std::string busy;
  if (is_refusal(of_count) || is_taken(file_, 0, count) || is_taken(file_, count + 1, kShards - count - 1))
    busy = "another number of shards";
  else if (is_refusal(of_shard))
    busy = shard.count == 1 ? "a sweep" : fmt::format("shard {}/{}", shard.number, shard.count);
  holds_ = of_count == 0 && of_shard == 0;
  if (busy.empty()) return;
  ::close(file_);
  throw TryLater(
      fmt::format("{}: {} runs in this folder already; the same command continues once that has ended",
                  folder.string(), busy));
}

ShardLock::~ShardLock() { ::close(file_); }

bool ShardLock::taken(const fs::path& folder) {
  const int file = ::open((folder / kLock).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool taken = is_taken(file, kAll, 0);
  ::close(file);
  return taken;
}

fs::path results_folder(const fs::path& sweep) { return sweep / "results"; }

std::string text_of_sweep(const fs::path& path) {
  refuse_standard_input(path);
  std::error_code none;
  if (!fs::exists(path, none)) refuse("{}: no such file", path.string());
  if (fs::is_directory(path, none))
    refuse("{}: is a directory, expected SWEEP.json; for its results use kds sweep status {}", path.string(),
           path.string());
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) refuse("{}: cannot be read", path.string());
  return text.str();
}

void check_sweep_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    refuse("-o {}: is a file, expected a directory", folder.string());
  for (fs::directory_iterator file(folder, error), end; file != end && !error; file.increment(error)) {
    // A sweep makes these before plan.json, and another shard may be starting.
    const std::string name = file->path().filename().string();
    if (name == results_folder("").string() || name == kLock || name.starts_with(kPlan)) continue;
    if (!fs::exists(folder / kPlan))
      refuse("-o {}: holds other files and no sweep, expected a new folder or that of a sweep",
             folder.string());
  }
}

void keep_plan(const fs::path& folder, const Json& sweep, const fs::path& relative,
               const InputFiles& inputs) {
  if (!line_of(Json(relative.string())))
    refuse("{}: the name of this folder is not UTF-8; expected the file of the sweep in another folder",
           relative.string());
  const std::string plan =
      text_of({{"folder", relative.string()}, {"inputs", inputs.json()}, {"sweep", sweep}});
  std::error_code error;
  fs::create_directories(results_folder(folder), error);
  if (error) refuse("-o {}: {}", folder.string(), error.message());
  if (fs::exists(folder / kPlan, error) && text_of_sweep(folder / kPlan) == plan) return;
  // Shards that start together write the plan at the same time, so AtomicFiles would refuse one of them.
  const fs::path part = folder / fmt::format("{}.{}.part", kPlan, ::getpid());
  std::ofstream file(part, std::ios::binary);
  file << plan << std::flush;
  if (!file) fail_to_write(part.string(), errno);
  fs::rename(part, folder / kPlan, error);
  if (error) fail_to_write((folder / kPlan).string(), error.value());
}

KeptPlan kept_plan(const fs::path& folder) {
  KeptPlan kept;
  kept.subject = (folder / kPlan).string();
  std::error_code none;
  if (!fs::exists(kept.subject, none)) return kept;
  const Json plan = read_json(text_of_sweep(kept.subject), kept.subject);
  const Json *const relative = plan.find("folder"), *const sweep = plan.find("sweep"),
                    *const inputs = plan.find("inputs");
  if (relative == nullptr || relative->text() == nullptr || sweep == nullptr)
    refuse("{}: expected the keys folder and sweep", kept.subject);
  kept.sweep = *sweep;
  kept.relative = *relative->text();
  if (inputs != nullptr) kept.inputs = *inputs;
  return kept;
}

}  // namespace kds
