#include "experiments/sweep/task_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <optional>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 5> kKinds{"try", "drop", "died", "fail", "done"};
constexpr std::string_view kGrowing = ".part", kResults = ".results";
constexpr std::size_t kHex = 16;
constexpr std::uint64_t kLongestJournal = std::uint64_t{64} << 20U;

std::optional<std::uint64_t> hex_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (text.size() != kHex || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Reads at most `size` bytes at `offset`. Returns fewer bytes only at the end of the file.
std::string bytes_of(const fs::path& file, std::uint64_t offset, std::size_t size) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::string bytes(size, '\0');
  std::size_t read = 0;
  while (read < size) {
    const ssize_t count =
        ::pread(descriptor, bytes.data() + read, size - read, static_cast<off_t>(offset + read));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    read += static_cast<std::size_t>(count);
  }
  ::close(descriptor);
  bytes.resize(read);
  return bytes;
}

}  // namespace

fs::path TaskStates::path(const Journal& journal, bool growing) const {
  return folder_ / (journal.stem + std::string(growing ? kGrowing : kResults));
}

void TaskStates::refresh() {
  std::error_code error;
  for (fs::directory_iterator file(folder_, error), end; file != end && !error; file.increment(error)) {
    const std::string name = file->path().filename().string();
    const bool growing = name.ends_with(kGrowing);
    if (!growing && !name.ends_with(kResults)) continue;
    const std::string stem = name.substr(0, name.size() - (growing ? kGrowing : kResults).size());
    const auto [found, is_new] = by_stem_.emplace(stem, static_cast<std::uint32_t>(journals_.size()));
    if (is_new) journals_.push_back({stem, 0, false});
    if (!journals_[found->second].complete) read_on(found->second, growing);
  }
}

void TaskStates::read_on(std::uint32_t journal, bool growing) {
  Journal& own = journals_[journal];
  std::error_code error;
  std::uint64_t size = fs::file_size(path(own, growing), error);
  if (error && growing) {  // renamed in the meantime
    growing = false;
    size = fs::file_size(path(own, growing), error);
  }
  if (error) return;
  constexpr std::size_t block = std::size_t{4} << 20U;
  std::string text;
  for (std::uint64_t from = own.read; from < size;) {
    const std::string read = bytes_of(path(own, growing), from, std::min<std::uint64_t>(block, size - from));
    if (read.empty()) break;
    from += read.size();
    text += read;
    std::size_t start = 0;
    for (std::size_t end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
      take(std::string_view(text).substr(start, end - start), journal, own.read + start);
    own.read += start;
    text.erase(0, start);
  }
  own.complete = !growing && own.read == size;
}

// A line is HASH KIND TASK JSON.
void TaskStates::take(std::string_view line, std::uint32_t journal, std::uint64_t offset) {
  const auto refuse = [this] { ++damaged_; };
  const auto hash = hex_number(line.substr(0, kHex));
  if (!hash || line.size() < kHex + 1 || line[kHex] != ' ' || TextHash::of(line.substr(kHex + 1)) != *hash)
    return refuse();
  const std::string_view rest = line.substr(kHex + 1);
  const std::size_t kind_end = std::min(rest.find(' '), rest.size());
  const auto kind = std::ranges::find(kKinds, rest.substr(0, kind_end));
  if (kind == kKinds.end() || rest.size() < kind_end + 1 + kHex + 1) return refuse();
  const auto name = hex_number(rest.substr(kind_end + 1, kHex));
  if (!name) return refuse();
  const std::size_t json = kHex + 1 + kind_end + 1 + kHex + 1;
  const RecordPlace place{journal, static_cast<std::uint32_t>(line.size() - json), offset + json};
  TaskState& task = tasks_[*name];
  switch (static_cast<RecordKind>(kind - kKinds.begin())) {
    case RecordKind::attempt:
      ++task.attempts;
      break;
    case RecordKind::drop:
      ++task.closed;
      break;
    case RecordKind::died:
      task.death = place;
      break;
    case RecordKind::fail:
      ++task.closed;
      task.failed = true;
      task.failure = place;
      break;
    case RecordKind::done:
      ++task.closed;
      if (!task.is_done()) task.done = place;
      break;
  }
}

const TaskState& TaskStates::of(TaskName task) const {
  static const TaskState untouched;
  const auto found = tasks_.find(task);
  return found == tasks_.end() ? untouched : found->second;
}

void TaskStates::forgive() {
  for (auto& [name, task] : tasks_) {
    task.failed = false;
    task.attempts = task.closed = 0;
  }
}

std::string TaskStates::read(const RecordPlace& place) const {
  const Journal& journal = journals_[place.journal];
  std::string text = bytes_of(path(journal, !journal.complete), place.offset, place.length);
  if (text.size() != place.length) text = bytes_of(path(journal, false), place.offset, place.length);
  if (text.size() != place.length)
    throw OutputError(
        fmt::format("{}: a journal was removed while it was read", path(journal, true).string()));
  return text;
}

JournalWriter::~JournalWriter() {
  if (file_ >= 0) ::close(file_);  // the records stay in the .part file
}

void JournalWriter::open() {
  std::uint64_t stem = 0;
  if (::getrandom(&stem, sizeof stem, 0) != sizeof stem) stem = static_cast<std::uint64_t>(::getpid());
  growing_ = folder_ / (hex_digits(stem) + std::string(kGrowing));
  file_ = ::open(growing_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) fail_to_write(growing_.string(), errno);
  size_ = 0;
}

bool JournalWriter::add(RecordKind kind, TaskName task, std::string_view json) {
  if (file_ < 0) open();
  const std::string rest =
      fmt::format("{} {} {}", kKinds[static_cast<std::size_t>(kind)], hex_digits(task), json);
  const std::string line = fmt::format("{} {}\n", hex_digits(TextHash::of(rest)), rest);
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t count = ::write(file_, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      if (::ftruncate(file_, static_cast<off_t>(size_)) != 0 ||
          ::lseek(file_, static_cast<off_t>(size_), SEEK_SET) < 0)
        fail_to_write(growing_.string(), errno);
      if (error == ENOSPC || error == EDQUOT || error == EFBIG) return false;
      fail_to_write(growing_.string(), error);
    }
    written += static_cast<std::size_t>(count);
  }
  size_ += line.size();
  if (!waits_) since_ = Clock::now();
  waits_ = true;
  if (size_ >= kLongestJournal) complete();
  return true;
}

void JournalWriter::sync() {
  if (::fdatasync(file_) != 0) fail_to_write(growing_.string(), errno);
  waits_ = false;
}

void JournalWriter::sync_now_and_then() {
  if (waits_ && Clock::now() - since_ >= std::chrono::seconds(1)) sync();
}

void JournalWriter::complete() {
  if (file_ < 0) return;
  sync();
  ::close(file_);
  file_ = -1;
  fs::path whole = growing_;
  whole.replace_extension(kResults);
  std::error_code error;
  fs::rename(growing_, whole, error);
  if (error) fail_to_write(whole.string(), error.value());
  const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
}

TaskLocks::TaskLocks(const fs::path& file, Use use)
    : file_(::open(file.c_str(), use == Use::take ? O_RDWR | O_CREAT | O_CLOEXEC : O_RDONLY | O_CLOEXEC,
                   0666)) {
  if (file_ < 0 && use == Use::take) fail_to_write(file.string(), errno);
  supported_ = file_ >= 0;
}

TaskLocks::~TaskLocks() {
  if (file_ >= 0) ::close(file_);
}

namespace {

struct flock lock_of(TaskName task, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(task >> 2U);  // off_t is signed
  lock.l_len = 1;
  return lock;
}

}  // namespace

bool TaskLocks::take(TaskName task) {
  struct flock lock = lock_of(task, F_WRLCK);
  while (supported_ && ::fcntl(file_, F_SETLK, &lock) != 0) {
    if (errno == EINTR) continue;
    if (errno == EAGAIN || errno == EACCES) return false;
    supported_ = false;
  }
  return true;
}

void TaskLocks::release(TaskName task) {
  struct flock lock = lock_of(task, F_UNLCK);
  if (supported_) static_cast<void>(::fcntl(file_, F_SETLK, &lock));
}

bool TaskLocks::taken_by_another(TaskName task) const {
  struct flock lock = lock_of(task, F_WRLCK);
  return supported_ && ::fcntl(file_, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

}  // namespace kds
