#include "experiments/output/replace_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "experiments/output/output_error.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, const std::string& subject)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) fail_to_write(subject, errno);
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

// Copies the finished file into `place`. Reserves the room first, so that the old content is not half
// overwritten when the disk is full.
void write_into(const fs::path& finished, const fs::path& place, const std::string& subject) {
  const Descriptor from(finished, O_RDONLY, subject), to(place, O_WRONLY | O_CREAT, subject);
  struct stat status {};
  if (::fstat(from, &status) != 0) fail_to_write(subject, errno);
  if (status.st_size > 0)
    if (const int error = ::posix_fallocate(to, 0, status.st_size);
        error != 0 && error != EINVAL && error != EOPNOTSUPP)
      fail_to_write(subject, error);
  std::array<char, 1 << 16> piece;
  for (;;) {
    const ssize_t got = ::read(from, piece.data(), piece.size());
    if (got == 0) break;
    if (got < 0 && errno != EINTR) fail_to_write(subject, errno);
    for (ssize_t written = 0; written < got;) {
      const ssize_t more = ::write(to, piece.data() + written, static_cast<std::size_t>(got - written));
      if (more < 0 && errno != EINTR) fail_to_write(subject, errno);
      written += more > 0 ? more : 0;
    }
  }
  if (::ftruncate(to, status.st_size) != 0) fail_to_write(subject, errno);
  ::unlink(finished.c_str());
}

// Gives the finished file the owner and permissions in `old`. Returns false if that is not permitted:
// changing the owner takes privileges.
bool take_over(const fs::path& finished, const struct stat& old) {
  struct stat own {};
  if (::stat(finished.c_str(), &own) != 0) return false;
  if ((own.st_uid != old.st_uid || own.st_gid != old.st_gid) &&
      ::chown(finished.c_str(), old.st_uid, old.st_gid) != 0)
    return false;
  return ::chmod(finished.c_str(), old.st_mode & 07777U) == 0;
}

// Returns whether the file is immutable or append-only. Even users with write permission cannot replace such
// a file.
bool is_kept(const fs::path& file) {
  struct statx status {};
  return ::statx(AT_FDCWD, file.c_str(), 0, 0, &status) == 0 &&
         (status.stx_attributes & (STATX_ATTR_IMMUTABLE | STATX_ATTR_APPEND)) != 0;
}

}  // namespace

SignalsWait::SignalsWait() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before_);
}

SignalsWait::~SignalsWait() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

fs::path link_target(const fs::path& path) {
  std::error_code error;
  fs::path place = path;
  for (int links = 0; fs::is_symlink(place, error) && links < 40; ++links) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) return path;
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  return place;
}

void check_replaceable(const fs::path& place) {
  const fs::path target = link_target(place);
  const std::string subject = place.string() + ": cannot write";
  std::error_code ignored;
  if (fs::is_symlink(target, ignored)) fail_to_write(subject, ELOOP);
  const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (::access(directory.c_str(), W_OK | X_OK) != 0) fail_to_write(subject, errno);
  struct stat old {};
  if (::stat(target.c_str(), &old) != 0) return;
  if (S_ISDIR(old.st_mode))
    throw InputError(fmt::format("{}: is a directory, expected a file", place.string()));
  if (!S_ISREG(old.st_mode)) throw InputError(fmt::format("{}: is no regular file", place.string()));
  if (is_kept(target)) fail_to_write(subject, EPERM);
  if (old.st_nlink > 1 && ::access(place.c_str(), W_OK) != 0)
    fail_to_write(place.string() + ": has other hard links and cannot be written", errno);
}

void replace_file(const fs::path& finished, const fs::path& place, const std::string& subject) {
  const fs::path target = link_target(place);
  struct stat old {};
  const bool there = ::stat(target.c_str(), &old) == 0 && S_ISREG(old.st_mode);
  if (there && (old.st_nlink > 1 || !take_over(finished, old))) return write_into(finished, target, subject);
  if (::rename(finished.c_str(), target.c_str()) == 0) return;
  if (errno != EXDEV) fail_to_write(subject, errno);
  write_into(finished, target, subject);
}

}  // namespace kds
