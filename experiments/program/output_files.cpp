#include "experiments/program/output_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "motions/base/input_error.h"

namespace kds {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

fs::path directory_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Renaming onto /dev/null or a pipe would replace it by a file.
bool is_device(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

// A new empty file in the directory; on failure errno tells why and the path is empty.
fs::path make_temporary(const fs::path& directory) {
  static std::atomic<unsigned> counter{0};
  for (;;) {
    fs::path name = directory / fmt::format(".kds-{}-{}.part", ::getpid(), counter++);
    const int file = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      return name;
    }
    if (errno != EEXIST) return {};
  }
}

void probe(const fs::path& directory, const std::string& subject) {
  const fs::path temporary = make_temporary(directory);
  if (temporary.empty()) throw InputError(fmt::format("{}: {}", subject, reason(errno)));
  std::error_code ignored;
  fs::remove(temporary, ignored);
}

}  // namespace

void ensure_directory(const fs::path& path, std::string_view option) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(fmt::format("{} {}: is a file, expected a directory", option, path.string()));
  fs::create_directories(path, error);
  if (error)
    throw InputError(
        fmt::format("{} {}: cannot make the directory: {}", option, path.string(), error.message()));
  probe(path, fmt::format("{} {}: cannot write there", option, path.string()));
}

void ensure_writable_file(const fs::path& path, std::string_view option) {
  std::error_code error;
  const fs::path directory = directory_of(path);
  if (fs::is_directory(path, error) || !path.has_filename())
    throw InputError(fmt::format("{} {}: is a directory, expected a file", option, path.string()));
  if (is_device(path)) return;
  if (!fs::is_directory(directory, error))
    throw InputError(
        fmt::format("{} {}: there is no directory {}", option, path.string(), directory.string()));
  probe(directory, fmt::format("{} {}: cannot write", option, path.string()));
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  std::error_code ignored;
  if (fs::is_directory(path_, ignored))
    throw InputError(fmt::format("{}: is a directory, expected a file", path_.string()));
  if (!is_device(path_)) {
    temporary_ = make_temporary(directory_of(path_));
    if (temporary_.empty())
      throw InputError(fmt::format("{}: cannot write: {}", path_.string(), reason(errno)));
    unfinished_.emplace(temporary_.string());
  }
  stream_.open(temporary_.empty() ? path_ : temporary_, std::ios::binary);
  stream_.imbue(std::locale::classic());
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  stream_.close();
  if (!stream_)
    throw InputError(
        fmt::format("{}: cannot write: {}", path_.string(), errno == 0 ? "output failed" : reason(errno)));
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) throw InputError(fmt::format("{}: cannot write: {}", path_.string(), error.message()));
  temporary_.clear();
  unfinished_.reset();
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  file.commit();
}

}  // namespace kds
