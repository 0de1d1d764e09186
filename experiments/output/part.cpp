#include "experiments/output/part.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string_view>

#include "experiments/output/output_error.h"
#include "experiments/output/replace_file.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kForAll = 0777;  // the user's umask removes bits

// Makes a new file or folder and returns its open descriptor. Returns -1 and sets errno on failure.
int make(const fs::path& path, Part::Kind kind) {
  if (kind == Part::Kind::file)
    return ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, kForAll & ~0111U);
  if (::mkdir(path.c_str(), kForAll) != 0) return -1;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int error = errno;
  if (descriptor < 0) ::rmdir(path.c_str());
  errno = error;
  return descriptor;
}

// Locks the file. Returns whether the file still exists: before the lock, another program may have removed it
// as stale.
bool lock_unless_removed(int descriptor) {
  ::flock(descriptor, LOCK_EX);  // without locks in the file system, stale files are never removed
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

}  // namespace

Part::Part(const fs::path& directory, Kind kind, const std::string& subject) {
  static std::atomic<unsigned> counter{0};
  for (int attempts = 0;; ++attempts) {
    path_ = directory / fmt::format(".kds-{}-{}.part", ::getpid(), counter++);
    unfinished_.emplace(path_.string());
    descriptor_ = make(path_, kind);
    constexpr int most_attempts = 1000;
    if (descriptor_ < 0) {
      const int error = errno;
      unfinished_.reset();  // an existing file with this name belongs to another program
      if (error != EEXIST || attempts == most_attempts) fail_to_write(subject, error);
    }
    if (descriptor_ < 0) continue;
    if (lock_unless_removed(descriptor_)) break;
    ::close(descriptor_);
  }
}

fs::path Part::add_file() {
  unfinished_->hold_files(++files_);
  return file(files_ - 1);
}

Part::~Part() {
  if (unfinished_) {  // remove files by name: listing a folder needs a descriptor, and none may be left
    for (std::uint64_t number = 0; number < files_; ++number) ::unlink(file(number).c_str());
    if (::unlink(path_.c_str()) != 0) ::rmdir(path_.c_str());
  }
  ::close(descriptor_);
}

void Part::become(const fs::path& place, const std::string& subject) {
  const SignalsWait wait;
  replace_file(path_, place, subject);
  unfinished_.reset();
}

namespace {

// Returns whether `name` has the form of Part's names: .kds-PROCESS-NUMBER.part
bool is_part(std::string_view name) {
  for (const std::string_view part : {".kds-", "-", ".part"}) {
    if (!name.starts_with(part)) return false;
    name.remove_prefix(part.size());
    if (part == ".part") break;
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    if (digits == 0) return false;
    name.remove_prefix(digits);
  }
  return name.empty();
}

}  // namespace

void clear_stale_parts(const fs::path& directory) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, ignored)) {
    if (!is_part(entry.path().filename().string())) continue;
    const int descriptor = ::open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry.path(), ignored);
    ::close(descriptor);
  }
}

}  // namespace kds
