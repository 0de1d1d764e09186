#include "experiments/output/output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "experiments/output/text.h"
#include "kds/event.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;  // symbolic links that lead to a file

fs::path directory_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
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

// Returns the place of a file, or nothing if the path is written directly. Throws an InputError that begins
// with `subject` if no file can be written there.
std::optional<fs::path> place_of_file(const fs::path& path, const std::string& subject) {
  std::error_code error;
  if (fs::is_directory(path, error) || !path.has_filename())
    throw InputError(subject + ": is a directory, expected a file");
  if (is_written_directly(path, subject)) return std::nullopt;
  fs::path place = place_of(path);
  if (fs::is_symlink(place, error)) fail_to_write(subject + ": cannot write", ELOOP);
  if (!fs::is_directory(place.parent_path(), error))
    throw InputError(fmt::format("{}: there is no directory {}", subject, place.parent_path().string()));
  return place;
}

// Returns the open descriptor of a new file. Throws as fail_to_write does.
int make_file(const fs::path& path, const std::string& subject) {
  const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(subject, errno);
  return descriptor;
}

// A hidden file in each folder of results. It is locked while the folder is written, and then begins with the
// line kUnfinished. Each other line is a file: the hash of its content, which is 0 until the folder is
// complete, and its name.
constexpr std::string_view kList = ".kds-results", kUnfinished = "unfinished";

std::uint64_t hash_of_content(const fs::path& path) {
  WordHash hash;
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(std::size_t{1} << 20U);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    for (std::streamsize k = 0; k < file.gcount(); ++k)
      hash.add(static_cast<unsigned char>(block[static_cast<std::size_t>(k)]));
  return hash.value();
}

// The contents of a folder's kList: its files, with hashes of their contents.
struct ResultList {
  explicit ResultList(const fs::path& folder) : files{{std::string(kList), 0}} {
    std::ifstream list(folder / kList);
    for (std::string line; std::getline(list, line);) {
      if (line == kUnfinished) {
        is_unfinished = true;
        continue;
      }
      const std::size_t name = line.find(' ') + 1;
      std::uint64_t hash = 0;
      std::from_chars(line.data(), line.data() + line.size(), hash, 16);
      files.emplace(line.substr(name), hash);
    }
  }
  static std::string line(const std::string& name, std::uint64_t hash) {
    return fmt::format("{:016x} {}\n", hash, name);
  }

  // Returns why an entry of the folder is none of the files as kds wrote them, or nothing if it is.
  [[nodiscard]] const char* fault_of(const fs::directory_entry& entry) const {
    std::error_code lost;
    const auto file = files.find(entry.path().filename().string());
    if (file == files.end() || entry.is_symlink(lost) || !entry.is_regular_file(lost))
      return "is not of an earlier result";
    if (is_unfinished || file->first == kList || hash_of_content(entry.path()) == file->second)
      return nullptr;
    return "has changed since kds wrote it";
  }
  // Returns the name of an entry with a fault, a space and the fault, or nothing.
  [[nodiscard]] std::string first_fault(const fs::path& folder, std::error_code& lost) const {
    for (fs::directory_iterator entry(folder, lost), end; !lost && entry != end; entry.increment(lost))
      if (const char* const fault = fault_of(*entry))
        return fmt::format("{} there {}", entry->path().filename().string(), fault);
    return {};
  }

  std::map<std::string, std::uint64_t> files;
  bool is_unfinished = false;
};

// Throws InputError if the place holds anything but an empty directory or, if `replace`, files that kds
// wrote.
void require_replaceable(const fs::path& place, const std::string& subject, bool replace) {
  std::error_code error;
  if (!fs::exists(place, error)) return;
  if (!fs::is_directory(place, error)) throw InputError(subject + ": is a file, expected a directory");
  if (leads_to(place, fs::current_path(error)))
    throw InputError(subject + ": is the working directory, expected a directory in it");
  struct stat own {};
  struct stat above {};
  if (::stat(place.c_str(), &own) == 0 && ::stat(place.parent_path().c_str(), &above) == 0 &&
      own.st_dev != above.st_dev)
    throw InputError(subject + ": is a mount point, expected a directory in it");
  std::error_code lost;
  if (fs::is_empty(place, lost)) return;
  if (lost) fail_to_write(subject, lost.value());
  if (!replace)
    throw InputError(subject +
                     ": holds files; --replace replaces an earlier result there, or give another directory");
  const std::string fault = ResultList(place).first_fault(place, lost);
  if (!fault.empty())
    throw InputError(fmt::format("{}: {}; move it or give another directory", subject, fault));
  if (lost) fail_to_write(subject, lost.value());
  if (const fs::path old = place.string() + ".old"; fs::exists(old, error))
    throw InputError(
        fmt::format("{}: move {} away, which may be an earlier result of an interrupted --replace", subject,
                    old.string()));
}

// Exchanges two directories at once, so that neither place is ever empty. Returns false if the system or the
// file system cannot.
bool exchange([[maybe_unused]] const fs::path& one, [[maybe_unused]] const fs::path& other) {
#ifdef RENAME_EXCHANGE
  return ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

// The directories above a place, made if they do not exist. Empty ones are removed at the end.
struct ParentsOf {
  ParentsOf(const fs::path& place, const std::string& subject) : last(place.parent_path()), first(last) {
    std::error_code error;
    while (!fs::exists(first, error) && first.has_relative_path()) first = first.parent_path();
    if (!fs::is_directory(first, error))
      throw InputError(fmt::format("{}: {} is a file, expected a directory", subject, first.string()));
    fs::create_directories(last, error);
    if (error) fail_to_write(subject + ": cannot make the directory", error.value());
  }
  ~ParentsOf() {
    std::error_code ignored;
    for (; last != first; last = last.parent_path()) fs::remove(last, ignored);
  }
  ParentsOf(const ParentsOf&) = delete;
  ParentsOf& operator=(const ParentsOf&) = delete;

  fs::path last, first;  // `first` existed
};

}  // namespace

struct PartFolder {
  // `its_subject` begins messages.
  PartFolder(fs::path its_place, const std::string& its_subject)
      : place(std::move(its_place)),
        path(place.string() + ".part"),
        subject(its_subject + ": cannot write"),
        parents(place, its_subject) {
    const bool is_new = ::mkdir(path.c_str(), 0777) == 0;
    if (!is_new && errno != EEXIST) fail_to_write(subject, errno);
    if (!is_new) refuse_what_is_no_leftover();
    const int descriptor = ::open((path / kList).c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      const int reason = errno;
      if (is_new) ::rmdir(path.c_str());
      fail_to_write(subject, reason);
    }
    list.emplace(descriptor, subject);
    // Without locks in the file system, two programs may write to one place.
    const bool is_locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    struct stat own {};
    struct stat there {};
    if (is_locked || ::fstat(descriptor, &own) != 0 || ::stat((path / kList).c_str(), &there) != 0 ||
        own.st_ino != there.st_ino)
      throw InputError(fmt::format("{}: another run writes to {} now; wait, or give another place", subject,
                                   path.string()));
    if (!is_new) clear();
    list_names(std::string(kUnfinished) + '\n');
  }
  ~PartFolder() {
    std::error_code ignored;
    if (!is_kept) fs::remove_all(path, ignored);
  }
  PartFolder(const PartFolder&) = delete;
  PartFolder& operator=(const PartFolder&) = delete;

  // A killed program leaves an empty folder, or files that its list names as unfinished.
  void refuse_what_is_no_leftover() const {
    std::error_code lost;
    std::string fault = "is not a directory";
    if (fs::is_directory(fs::symlink_status(path, lost))) {
      const ResultList found(path);
      fault = found.first_fault(path, lost);
      if (lost) fail_to_write(subject, lost.value());
      if (fault.empty() && !found.is_unfinished && found.files.size() > 1) fault = "holds a complete result";
    }
    if (!fault.empty())
      throw InputError(fmt::format("{}: {} is in the way: {}; move it", subject, path.string(), fault));
  }

  // Removes what a killed program has left.
  void clear() const {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
      if (entry.path().filename() != kList) fs::remove_all(entry.path(), error);
    if (::ftruncate(list->descriptor(), 0) != 0) fail_to_write(subject, errno);
    std::fputs(fmt::format("kds: warning: {} was left by a run that was stopped, and is replaced\n",
                           one_line(path.string()))
                   .c_str(),
               stderr);
  }

  [[nodiscard]] fs::path file() const { return path / place.filename(); }

  void list_names(const std::string& names) {
    *list << names << std::flush;
    list->check();
  }

  // Lists the contents of the files, whose names are on a line each.
  void complete_list(const std::string& names) {
    std::string lines;
    std::istringstream all(names);
    for (std::string name; std::getline(all, name);)
      lines += ResultList::line(name, hash_of_content(path / name));
    if (::ftruncate(list->descriptor(), 0) != 0 || ::lseek(list->descriptor(), 0, SEEK_SET) != 0)
      fail_to_write(subject, errno);
    list_names(lines);
  }

  // Moves the file to its place. The new file gets the permissions and, if permitted, the owner of the old
  // one.
  void become_file() {
    struct stat old {};
    if (::stat(place.c_str(), &old) == 0) {
      if (::chown(file().c_str(), old.st_uid, old.st_gid) != 0) errno = 0;
      ::chmod(file().c_str(), old.st_mode & 07777U);
    }
    move(file(), place);
  }

  // Makes the folder the directory of results. An earlier one is moved aside and then removed.
  void become_directory() {
    const fs::path old = place.string() + ".old";
    std::error_code ignored;
    const bool is_there = fs::exists(place, ignored), is_full = is_there && !fs::is_empty(place, ignored);
    if (is_there) fs::permissions(path, fs::status(place, ignored).permissions(), ignored);
    const bool is_exchanged = is_full && exchange(path, place);
    if (is_exchanged && ::rename(path.c_str(), old.c_str()) != 0)
      fail_to_write(
          fmt::format("{}: the result is there; the earlier one stays in {}", place.string(), path.string()),
          errno);
    if (is_full && !is_exchanged) move(place, old);
    try {
      if (!is_exchanged) move(path, place);
    } catch (...) {
      if (is_full) fs::rename(old, place, ignored);
      throw;
    }
    is_kept = true;
    if (!is_full) return;
    const ResultList found(old);
    for (const auto& [name, hash] : found.files)
      if (name != kList && found.fault_of(fs::directory_entry(old / name, ignored)) == nullptr)
        fs::remove(old / name, ignored);
    // A file may have come since the last check.
    if (std::distance(fs::directory_iterator(old, ignored), fs::directory_iterator()) == 1)
      fs::remove_all(old, ignored);
    else
      std::fputs(fmt::format("kds: warning: {} keeps files that were not of the earlier result\n",
                             one_line(old.string()))
                     .c_str(),
                 stderr);
  }

  void move(const fs::path& from, const fs::path& to) {
    if (::rename(from.c_str(), to.c_str()) == 0) return;
    is_kept = true;
    fail_to_write(kept_result(), errno);
  }
  [[nodiscard]] std::string kept_result() const {
    return fmt::format("{}, so the result stays in {}", subject, path.string());
  }

  fs::path place, path;
  std::string subject;
  ParentsOf parents;
  std::optional<OutputStream> list;
  bool is_kept = false;  ///< whether the folder stays
};

fs::path place_of(const fs::path& path) {
  std::error_code lost;
  fs::path whole = fs::absolute(path, lost);
  for (int links = 0; links < kMostLinks && fs::is_symlink(whole, lost); ++links)  // missing targets too
    whole = whole.parent_path() / fs::read_symlink(whole, lost);
  const fs::path found = fs::weakly_canonical(whole, lost);
  const fs::path place = (lost ? whole : found).lexically_normal();
  return place.has_filename() ? place : place.parent_path();  // a/ becomes a
}

bool leads_to(const fs::path& path, const fs::path& other) {
  const fs::path start = place_of(path), whole = place_of(other);
  return std::mismatch(start.begin(), start.end(), whole.begin(), whole.end()).first == start.end();
}

bool lies_in(const fs::path& path, const fs::path& directory) {
  return path.has_filename() && place_of(directory_of(path)) == place_of(directory);
}

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

namespace {

int open_unnamed_file() {
  std::FILE* const file = std::tmpfile();
  const int descriptor = file == nullptr ? -1 : ::fcntl(::fileno(file), F_DUPFD_CLOEXEC, 0);
  if (file != nullptr) std::fclose(file);
  if (descriptor < 0) fail_to_write("cannot make a temporary file", errno);
  return descriptor;
}

}  // namespace

UnnamedFile::UnnamedFile() : stream_(open_unnamed_file(), "cannot write a temporary file") {}

void UnnamedFile::copy_to(std::ostream& other) {
  stream_.flush();
  stream_.check();
  std::vector<char> block(std::size_t{1} << 16U);
  ssize_t count = 0;
  for (off_t at = 0; (count = ::pread(stream_.descriptor(), block.data(), block.size(), at)) > 0; at += count)
    other.write(block.data(), count);
  if (count < 0) fail_to_write("cannot read a temporary file", errno);
}

AtomicFiles::AtomicFiles() = default;
AtomicFiles::~AtomicFiles() = default;

AtomicFiles::AtomicFiles(const fs::path& directory, std::string_view option, bool replace)
    : is_directory_(true), replace_(replace), subject_(fmt::format("{} {}", option, directory.string())) {
  require_replaceable(place_of(directory), subject_, replace);
  parts_.emplace_back(place_of(directory), subject_);
}

std::ostream& AtomicFiles::open(const fs::path& place) {
  if (is_directory_) {
    const bool is_path = place.has_parent_path() && lies_in(place, parts_.front().place);
    const std::string name = (is_path ? place.filename() : place).string();
    if (name.empty() || name.find_first_of("/\n") != std::string::npos || name == kList)
      throw std::logic_error("'" + name + "' is no name for a file of a result");
    names_ += name + '\n';
    PartFolder& part = parts_.front();
    part.list_names(ResultList::line(name, 0));
    return open_.emplace_back(make_file(part.path / name, part.subject), part.subject);
  }
  if (const auto file = place_of_file(place, place.string())) {
    PartFolder& part = parts_.emplace_back(*file, place.string());
    part.list_names(ResultList::line(part.file().filename().string(), 0));
    return open_.emplace_back(make_file(part.file(), part.subject), part.subject);
  }
  const auto own = descriptor_behind(place);
  const std::string subject = place.string() + ": cannot write";
  const int descriptor =
      own ? ::fcntl(*own, F_DUPFD_CLOEXEC, 0) : ::open(place.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(subject, errno);
  return open_.emplace_back(descriptor, subject);
}

void AtomicFiles::write(const fs::path& place, std::string_view text) {
  const std::size_t parts = parts_.size();
  open(place) << text;
  if (!is_directory_ && parts_.size() == parts)
    return;  // an output that is written directly gets its text at the end
  open_.back().close();
  open_.pop_back();
}

void AtomicFiles::check() const {
  for (const OutputStream& file : open_) file.check();
}

std::optional<std::string> AtomicFiles::commit_and_begin_anew() {
  const fs::path place = parts_.front().place;
  std::optional<std::string> reason;
  try {
    require_replaceable(place, subject_, replace_);
  } catch (const InputError& error) {
    reason = error.what();
  }
  if (!reason) {
    commit_together({this});
    replace_ = true;
  }
  open_.clear();
  names_.clear();
  parts_.clear();
  parts_.emplace_back(place, subject_);
  return reason;
}

void AtomicFiles::finish() {
  for (OutputStream& file : open_) file.close();
  if (!is_directory_) return;
  PartFolder& part = parts_.front();
  part.complete_list(names_);
  part.is_kept = true;
  require_replaceable(part.place, part.kept_result(), replace_);
  part.is_kept = false;
}

void AtomicFiles::take_places() {
  for (PartFolder& part : parts_) is_directory_ ? part.become_directory() : part.become_file();
}

void commit_together(std::initializer_list<AtomicFiles*> results) {
  for (AtomicFiles* const result : results)
    if (result != nullptr) result->finish();
  for (AtomicFiles* const result : results)
    if (result != nullptr) result->take_places();
}

namespace {

// Removes the earlier result that a killed run has moved aside.
void remove_old(const fs::path& place, const std::string& subject) {
  const fs::path old = place.string() + ".old";
  std::error_code lost;
  if (!fs::exists(fs::symlink_status(old, lost))) return;
  std::string fault = "is not a directory";
  if (fs::is_directory(fs::symlink_status(old, lost))) fault = ResultList(old).first_fault(old, lost);
  if (fault.empty() && !fs::exists(place, lost)) fault = "holds the only result";
  if (!fault.empty())
    throw InputError(fmt::format("{}: {} is in the way: {}; move it", subject, old.string(), fault));
  fs::remove_all(old, lost);
}

}  // namespace

void check_no_writer(const fs::path& path, std::string_view option) {
  const std::string subject = fmt::format("{} {}", option, path.string());
  const PartFolder trial(place_of(path), subject);
}

void check_directory(const fs::path& path, std::string_view option, bool replace) {
  const std::string subject = fmt::format("{} {}", option, path.string());
  require_replaceable(place_of(path), subject, replace);
  const PartFolder trial(place_of(path), subject);
  remove_old(place_of(path), subject);
}

void ensure_writable_file(const fs::path& path, std::string_view option) {
  const std::string subject = fmt::format("{} {}", option, path.string());
  if (const auto place = place_of_file(path, subject)) const PartFolder trial(*place, subject);
}

void check_writable(const Destinations& destinations) {
  const auto& json = destinations.json;
  if (json && *json != "-") ensure_writable_file(*json, "--json");
  if (destinations.out) check_directory(*destinations.out, "--out", destinations.replace);
}

}  // namespace kds
