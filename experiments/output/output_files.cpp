#include "experiments/output/output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <locale>
#include <set>
#include <system_error>

#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;  // symbolic links that lead to a file

fs::path directory_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::string cannot_write(const fs::path& path) { return path.string() + ": cannot write"; }

// Returns where a symbolic link leads, which need not exist. Returns any other path unchanged.
fs::path link_target(const fs::path& path) {
  std::error_code error;
  fs::path place = path;
  for (int links = 0; fs::is_symlink(place, error) && links < kMostLinks; ++links) {
    const fs::path target = fs::read_symlink(place, error);
    if (error) return path;
    place = directory_of(place) / target;
  }
  return place;
}

// Returns the descriptor of this program to which the path leads, if a link on the way lies in /proc/self/fd.
// Such a link need not contain a path. A file that it leads to must not be opened again: it would be written
// from its beginning, over the text that standard output has already written.
std::optional<int> descriptor_behind(fs::path path) {
  std::error_code error;
  const fs::path descriptors = fs::canonical("/proc/self/fd", error);
  for (int links = 0; !error && links < kMostLinks; ++links) {
    const fs::path folder = directory_of(path);
    if (fs::weakly_canonical(folder, error) == descriptors && !error) {
      const std::string name = path.filename().string();
      const char* const end = name.data() + name.size();
      int number = -1;
      const auto [after, wrong] = std::from_chars(name.data(), end, number);
      return wrong == std::errc() && after == end && number >= 0 ? std::optional(number) : std::nullopt;
    }
    if (!fs::is_symlink(path, error)) return std::nullopt;
    path = folder / fs::read_symlink(path, error);
  }
  return std::nullopt;
}

// Returns whether the path is written directly, without an atomic rename: a device or a descriptor of this
// program. Throws an InputError that begins with `subject` for a named pipe, which blocks until another
// program reads it, a socket, or a descriptor that is not open for writing.
bool is_written_directly(const fs::path& path, const std::string& subject) {
  if (const auto descriptor = descriptor_behind(path)) {
    const int flags = ::fcntl(*descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
      throw InputError(subject + ": this descriptor is not open for writing");
    return true;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_fifo(status))
    throw InputError(subject + ": is a named pipe, expected a file, a device or, for a pipe, /dev/stdout");
  if (fs::is_socket(status)) throw InputError(subject + ": is a socket, expected a file or a device");
  return fs::is_character_file(status) || fs::is_block_file(status);
}

// Returns whether the file is immutable or append-only. Even users with write permission cannot replace such
// a file.
bool is_kept(const fs::path& file) {
  struct statx status {};
  return ::statx(AT_FDCWD, file.c_str(), 0, 0, &status) == 0 &&
         (status.stx_attributes & (STATX_ATTR_IMMUTABLE | STATX_ATTR_APPEND)) != 0;
}

// Throws InputError or OutputError if replace_file would fail for a reason that is known beforehand.
void check_replaceable(const fs::path& place) {
  const fs::path target = link_target(place);
  const std::string subject = cannot_write(place);
  std::error_code ignored;
  if (fs::is_symlink(target, ignored)) fail_to_write(subject, ELOOP);
  if (::access(directory_of(target).c_str(), W_OK | X_OK) != 0) fail_to_write(subject, errno);
  struct stat old {};
  if (::stat(target.c_str(), &old) != 0) return;
  if (S_ISDIR(old.st_mode)) throw InputError(place.string() + ": is a directory, expected a file");
  if (!S_ISREG(old.st_mode)) throw InputError(place.string() + ": is no regular file");
  if (is_kept(target)) fail_to_write(subject, EPERM);
  if (old.st_nlink > 1 && ::access(place.c_str(), W_OK) != 0)
    fail_to_write(place.string() + ": has other hard links and cannot be written", errno);
}

// Returns an open descriptor. Throws as fail_to_write does.
int open_file(const fs::path& path, int flags, const std::string& subject) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(subject, errno);
  return descriptor;
}

int make_file(const fs::path& path, const std::string& subject) {
  return open_file(path, O_CREAT | O_EXCL | O_WRONLY, subject);
}

// Copies the finished file into `place`. Reserves the room first, so that the old content is not half
// overwritten when the disk is full.
void write_into(const fs::path& finished, const fs::path& place, const std::string& subject) {
  std::ifstream from(finished, std::ios::binary);
  const auto size = static_cast<off_t>(fs::file_size(finished));
  OutputStream to(open_file(place, O_WRONLY | O_CREAT, subject), subject);
  if (size > 0) {
    if (const int error = ::posix_fallocate(to.descriptor(), 0, size);
        error != 0 && error != EINVAL && error != EOPNOTSUPP)
      fail_to_write(subject, error);
    to << from.rdbuf();
    to.check();
    if (from.tellg() != size) fail_to_write(subject, 0);
  }
  if (::ftruncate(to.descriptor(), size) != 0) fail_to_write(subject, errno);
  to.close();
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

// Moves the finished file to `place`. A symbolic link there stays, and its target is replaced. The new file
// gets the permissions and owner of the old file. The old file is overwritten instead if it has other hard
// links, if its owner cannot be passed on, or if it lies on another disk.
void replace_file(const fs::path& finished, const fs::path& place) {
  const fs::path target = link_target(place);
  const std::string subject = cannot_write(place);
  struct stat old {};
  const bool there = ::stat(target.c_str(), &old) == 0 && S_ISREG(old.st_mode);
  if (there && (old.st_nlink > 1 || !take_over(finished, old))) return write_into(finished, target, subject);
  if (::rename(finished.c_str(), target.c_str()) == 0) return;
  if (errno != EXDEV) fail_to_write(subject, errno);
  write_into(finished, target, subject);
}

// Returns whether the name has the form .kds-PROCESS-NUMBER.part
bool is_part(std::string_view name) {
  for (const std::string_view piece : {".kds-", "-"}) {
    if (!name.starts_with(piece)) return false;
    name.remove_prefix(piece.size());
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    if (digits == 0) return false;
    name.remove_prefix(digits);
  }
  return name == ".part";
}

// Removes the hidden folders that killed programs left in the directory: those that no process has locked.
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

std::string name_of(const std::string& path) { return fs::path(path).filename().string(); }

// Blocks the catchable signals of this thread during its life, so that no signal stops a replacement halfway.
struct SignalsWait {
  SignalsWait() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);
  }
  ~SignalsWait() { ::pthread_sigmask(SIG_SETMASK, &before, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

  sigset_t before;
};

}  // namespace

// The hidden folder in which results are written before they are moved to their places. The folder is locked,
// so that other programs see that it is in use.
struct StagingFolder {
  StagingFolder(const fs::path& directory, const std::string& subject) : beside(directory) {
    static std::atomic<unsigned> counter{0};
    constexpr int most_attempts = 1000;
    for (int attempts = 1;; ++attempts) {
      try {
        waiting.emplace((directory / fmt::format(".kds-{}-{}.part", ::getpid(), counter++)).string(), 0700);
      } catch (const std::system_error& error) {
        if (error.code().value() != EEXIST || attempts == most_attempts)
          fail_to_write(subject, error.code().value());
        continue;
      }
      lock = ::open(waiting->path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      if (lock < 0 && errno != ENOENT) fail_to_write(subject, errno);
      ::flock(lock, LOCK_EX);  // without locks in the file system, stale folders are never removed
      struct stat status {};
      if (::fstat(lock, &status) == 0 && status.st_nlink > 0) return;
      ::close(lock);  // another program removed the folder as stale before it was locked
    }
  }
  ~StagingFolder() { ::close(lock); }
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  fs::path beside;  ///< the directory that contains the folder
  std::optional<UnfinishedFolder> waiting;
  int lock = -1;
};

void fail_to_write(const std::string& subject, int error) {
  const std::string message =
      subject + ": " + (error == 0 ? "output failed" : std::generic_category().message(error));
  constexpr std::array refused{EACCES, EEXIST, EISDIR, ELOOP, ENAMETOOLONG, ENOENT, ENOTDIR, EPERM, EROFS};
  if (std::ranges::find(refused, error) != refused.end()) throw InputError(message);
  throw OutputError(message);
}

void print_to_stdout(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  fail_to_write("cannot write to standard output", errno);
}

OutputStream::Buffer::Buffer(int number) : descriptor(number), bytes(std::size_t{1} << 16U) {
  setp(bytes.data(), bytes.data() + bytes.size());
}

OutputStream::Buffer::int_type OutputStream::Buffer::overflow(int_type c) {
  if (sync() != 0) return traits_type::eof();
  return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                         : sputc(traits_type::to_char_type(c));
}

int OutputStream::Buffer::sync() {
  const char* next = pbase();
  while (error == 0 && next < pptr()) {
    const ssize_t written = ::write(descriptor, next, static_cast<std::size_t>(pptr() - next));
    if (written >= 0) {
      next += written;
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  setp(bytes.data(), bytes.data() + bytes.size());
  return error == 0 ? 0 : -1;
}

OutputStream::OutputStream(int descriptor, std::string subject)
    : std::ostream(nullptr), subject_(std::move(subject)), buffer_(descriptor) {
  rdbuf(&buffer_);
  imbue(std::locale::classic());
}

OutputStream::~OutputStream() {
  if (buffer_.descriptor >= 0) ::close(buffer_.descriptor);
}

void OutputStream::check() const {
  if (buffer_.error != 0) fail_to_write(subject_, buffer_.error);
}

void OutputStream::close() {
  buffer_.pubsync();
  check();
  if (::close(std::exchange(buffer_.descriptor, -1)) != 0) fail_to_write(subject_, errno);
}

AtomicFiles::AtomicFiles(fs::path directory, std::string_view command, std::string_view option)
    : directory_(std::move(directory)),
      subject_(fmt::format("{} {}: cannot write", option, directory_.string())) {
  fs::path current;
  std::error_code ignored;
  for (const fs::path& name : directory_) {
    current /= name;
    if (name.empty() || fs::is_directory(current, ignored)) continue;
    try {
      made_.emplace_front(current.string(), 0777);
    } catch (const std::system_error& error) {
      if (fs::is_directory(current, ignored)) continue;  // another program made it first
      fail_to_write(fmt::format("{} {}: cannot make the directory", option, directory_.string()),
                    error.code().value());
    }
  }
  folder_in(directory_, subject_);
  earlier_.emplace(directory_, command, option);
}

AtomicFiles::AtomicFiles() = default;
AtomicFiles::~AtomicFiles() = default;

StagingFolder& AtomicFiles::folder_in(const fs::path& directory, const std::string& subject) {
  for (StagingFolder& folder : folders_)
    if (folder.beside == directory) return folder;
  clear_stale_parts(directory);
  return folders_.emplace_back(directory, subject);
}

std::ostream& AtomicFiles::open(const fs::path& place) {
  fs::path directory = directory_, target = directory_ / place;
  std::string subject = subject_;
  if (earlier_) {
    const std::string name = place.string();
    if (name.empty() || name.find_first_of("/\n") != std::string::npos)
      throw std::logic_error("'" + name + "' is no name for a file of a result");
    earlier_->require_own(name);
  } else {
    std::error_code ignored;
    if (fs::is_directory(place, ignored))
      throw InputError(place.string() + ": is a directory, expected a file");
    if (is_written_directly(place, place.string())) {
      const auto own = descriptor_behind(place);
      const int descriptor =
          own ? ::fcntl(*own, F_DUPFD_CLOEXEC, 0) : ::open(place.c_str(), O_WRONLY | O_CLOEXEC);
      if (descriptor < 0) fail_to_write(cannot_write(place), errno);
      return open_.emplace_back(descriptor, cannot_write(place));
    }
    target = link_target(place);
    directory = directory_of(target);
    subject = cannot_write(target);
  }
  const fs::path waiting = folder_in(directory, subject).waiting->add_file();
  files_.push_back({waiting.string(), target.string()});
  return open_.emplace_back(make_file(waiting, subject), subject);
}

void AtomicFiles::write(const fs::path& place, std::string_view text) {
  const std::size_t staged = files_.size();
  open(place) << text;
  if (files_.size() == staged) return;  // an output that is written directly gets its text at the end
  open_.back().close();
  open_.pop_back();
}

void AtomicFiles::check() const {
  for (const OutputStream& file : open_) file.check();
}

void AtomicFiles::refuse_others(const std::function<bool(std::string_view name)>& belongs) const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (belongs(name)) earlier_->require_own(name);
  }
}

void AtomicFiles::finish() {
  for (OutputStream& file : open_) file.close();
  for (const File& file : files_) {
    check_replaceable(file.place);
    if (earlier_) earlier_->require_own(name_of(file.place));
  }
  if (!earlier_) return;
  check_replaceable(earlier_->path());
  const auto write_manifest = [&](const std::string& text) -> fs::path {
    const fs::path path = folders_.front().waiting->add_file();
    OutputStream file(make_file(path, subject_), subject_);
    file << earlier_->heading() << '\n' << text;
    file.close();
    return path;
  };
  std::string lines;
  for (const File& file : files_) lines += ResultManifest::line(file.waiting, name_of(file.place));
  both_ = write_manifest(earlier_->lines() + lines);
  manifest_ = write_manifest(lines);
}

// At each moment a manifest must list every present file of a result, because the program may be killed.
void AtomicFiles::take_places() {
  if (earlier_) replace_file(both_, earlier_->path());
  for (const File& file : files_) replace_file(file.waiting, file.place);
  if (!earlier_) return;
  std::set<std::string> now;
  if (!earlier_->empty())
    for (const File& file : files_) now.insert(name_of(file.place));
  std::error_code ignored;
  for (const auto& [name, content] : earlier_->files())
    if (!now.contains(name) && earlier_->is_own(name)) fs::remove(directory_ / name, ignored);
  replace_file(manifest_, earlier_->path());
}

void commit_together(std::initializer_list<AtomicFiles*> results) {
  for (AtomicFiles* const result : results)
    if (result != nullptr) result->finish();
  const SignalsWait wait;
  for (AtomicFiles* const result : results)
    if (result != nullptr) result->take_places();
}

namespace {

// Returns the deepest ancestor of the path that exists.
fs::path existing_part(const fs::path& path, const std::string& subject) {
  for (fs::path part = path;; part = part.parent_path()) {
    std::error_code error;
    const fs::file_status status = fs::status(part.empty() ? "." : part, error);
    if (fs::exists(status)) return part.empty() ? "." : part;
    if (status.type() != fs::file_type::not_found) fail_to_write(subject, error.value());
  }
}

}  // namespace

void check_directory(const fs::path& path, std::string_view command, std::string_view option,
                     std::initializer_list<std::string_view> names) {
  const std::string place = fmt::format("{} {}", option, path.string());
  const fs::path there = existing_part(path, place + ": cannot make the directory");
  std::error_code error;
  if (!fs::is_directory(there, error))
    throw InputError(fmt::format("{}: {}is a file, expected a directory", place,
                                 there == path ? "" : there.string() + " "));
  const StagingFolder trial(
      there, fmt::format("{}: cannot write {}", place, there == path ? "there" : "in " + there.string()));
  const ResultManifest earlier(path, command, option);
  for (const std::string_view name : names) {
    if (fs::is_directory(path / name, error))
      throw InputError(fmt::format("{} {}: is a directory, expected a file", option, (path / name).string()));
    if (fs::exists(path / name, error)) check_replaceable(path / name);
    earlier.require_own(std::string(name));
  }
}

void ensure_writable_file(const fs::path& path, std::string_view option) {
  const std::string place = fmt::format("{} {}", option, path.string());
  std::error_code error;
  if (fs::is_directory(path, error) || !path.has_filename())
    throw InputError(place + ": is a directory, expected a file");
  if (is_written_directly(path, place)) return;
  const fs::path directory = directory_of(link_target(path));
  if (!fs::is_directory(directory, error))
    throw InputError(place + ": there is no directory " + directory.string());
  check_replaceable(path);
  const StagingFolder trial(directory, place + ": cannot write");
}

}  // namespace kds
