#include "experiments/output/output_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <locale>
#include <system_error>
#include <utility>

#include "experiments/output/output_error.h"
#include "experiments/output/replace_file.h"
#include "experiments/output/result_manifest.h"
#include "experiments/output/straight_output.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

namespace fs = std::filesystem;

fs::path directory_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Returns the deepest ancestor of the path that exists.
fs::path existing_part(const fs::path& path, const std::string& subject) {
  fs::path part = path;
  for (;;) {
    std::error_code error;
    const fs::file_status status = fs::status(part.empty() ? "." : part, error);
    if (fs::exists(status)) return part.empty() ? "." : part;
    if (status.type() != fs::file_type::not_found) fail_to_write(subject, error.value());
    part = part.parent_path();
  }
}

void probe(const fs::path& directory, const std::string& subject) {
  const Part trial(directory, Part::Kind::file, subject);
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
  probe(there, fmt::format("{}: cannot write {}", place, there == path ? "there" : "in " + there.string()));
  const ResultManifest earlier(path, command, option);
  for (const std::string_view name : names) {
    if (fs::is_directory(path / name, error))
      throw InputError(fmt::format("{} {}: is a directory, expected a file", option, (path / name).string()));
    if (fs::exists(path / name, error)) check_replaceable(path / name);
    earlier.require_own(std::string(name));
  }
}

void ensure_writable_file(const fs::path& path, std::string_view option) {
  std::error_code error;
  if (fs::is_directory(path, error) || !path.has_filename())
    throw InputError(fmt::format("{} {}: is a directory, expected a file", option, path.string()));
  if (is_straight_output(path, fmt::format("{} {}", option, path.string()))) return;
  const fs::path directory = directory_of(link_target(path));
  if (!fs::is_directory(directory, error))
    throw InputError(
        fmt::format("{} {}: there is no directory {}", option, path.string(), directory.string()));
  check_replaceable(path);
  probe(directory, fmt::format("{} {}: cannot write", option, path.string()));
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), stream_(nullptr) {
  std::error_code ignored;
  if (fs::is_directory(path_, ignored))
    throw InputError(fmt::format("{}: is a directory, expected a file", path_.string()));
  if (is_straight_output(path_, path_.string())) {
    descriptor_ = open_straight_output(path_, subject());
  } else {
    path_ = link_target(path_);
    clear_stale_parts(directory_of(path_));
    part_.emplace(directory_of(path_), Part::Kind::file, subject());
  }
  buffer_.emplace(part_ ? part_->descriptor() : descriptor_);
  stream_.rdbuf(&*buffer_);
  stream_.imbue(std::locale::classic());
}

AtomicFile::AtomicFile(fs::path path, std::string_view content) : AtomicFile(std::move(path)) {
  stream_.write(content.data(), static_cast<std::streamsize>(content.size()));
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::check() const {
  if (buffer_->error() != 0) fail_to_write(subject(), buffer_->error());
}

void AtomicFile::finish() {
  buffer_->pubsync();
  check();
  // Some file systems report a lack of room only on close. Closing a copy of the descriptor detects it, while
  // the file itself stays open and locked.
  const int copy = ::dup(part_ ? part_->descriptor() : descriptor_);
  if (copy >= 0 && ::close(copy) != 0) fail_to_write(subject(), errno);
  if (part_) check_replaceable(path_);
}

void AtomicFile::take_place() {
  if (part_) part_->become(path_, subject());
}

}  // namespace kds
