#include "motions/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

namespace kds {

namespace {

void check_kind(const std::string& name, mode_t mode) {
  if (S_ISREG(mode)) return;
  throw InputError(fmt::format("{}: this is a {}, expected a file", name,
                               S_ISDIR(mode)    ? "folder"
                               : S_ISFIFO(mode) ? "pipe"
                               : S_ISSOCK(mode) ? "socket"
                                                : "device"));
}

struct Opened {
  gzFile file;
  std::uint64_t size;
};

Opened open_regular(const std::string& name) {
  struct stat status {};
  if (::stat(name.c_str(), &status) == 0) check_kind(name, status.st_mode);
  // Do not block if the path has meanwhile become a pipe without a writer.
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw InputError(fmt::format("{}: cannot open this file", name));
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    check_kind(name, status.st_mode);
    throw InputError(fmt::format("{}: cannot open this file", name));
  }
  const gzFile file = ::gzdopen(descriptor, "rb");  // passes uncompressed data through
  if (file == nullptr) {
    ::close(descriptor);
    throw InputError(fmt::format("{}: cannot open this file", name));
  }
  return {file, static_cast<std::uint64_t>(status.st_size)};
}

}  // namespace

std::size_t byte_order_mark(std::string_view start, const std::string& file) {
  if (start.starts_with("\xEF\xBB\xBF")) return 3;
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
    throw InputError(fmt::format("{}: this text is UTF-16, expected ASCII or UTF-8", file));
  return 0;
}

void require_regular_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw InputError(fmt::format("{}: cannot open this file", path.string()));
  check_kind(path.string(), status.st_mode);
}

InputFile::InputFile(const std::filesystem::path& path) : name_(path.string()), file_(nullptr, gzclose) {
  const Opened opened = open_regular(name_);
  file_.reset(opened.file);
  size_ = opened.size;
}

std::size_t InputFile::read(char* to, std::size_t size) {
  size = std::min<std::size_t>(size, 1U << 30U);
  const bool plain = gzdirect(file_.get()) != 0;
  if (plain) size = static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - std::min(read_, size_)));
  if (size == 0) return 0;
  const int got = gzread(file_.get(), to, static_cast<unsigned>(size));
  int code = Z_OK;
  const char* const why = got < static_cast<int>(size) ? gzerror(file_.get(), &code) : "";
  if (got <= 0 && code == Z_BUF_ERROR)
    throw CutFile(fmt::format("{}: cannot read this file to its end: the gzipped file is cut off", name_));
  if (got < 0 || (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR))
    throw InputError(fmt::format("{}: cannot read this file ({})", name_, why));
  read_ += static_cast<std::uint64_t>(got);
  if (!plain && read_ > most_unpacked && read_ / most_ratio > size_)
    throw InputError(fmt::format("{}: unpacks to more than {} times its size, which no coordinates do", name_,
                                 most_ratio));
  return static_cast<std::size_t>(got);
}

void InputFile::seek(std::uint64_t place) {
  if (place == read_) return;
  if (gzdirect(file_.get()) != 0) {
    place = std::min(place, size_);
    if (gzseek(file_.get(), static_cast<z_off_t>(place), SEEK_SET) < 0)
      throw InputError(fmt::format("{}: cannot read this file", name_));
    read_ = place;
    return;
  }
  if (place < read_) rewind();
  std::array<char, 1 << 15> skipped;
  while (read_ < place)
    if (read(skipped.data(),
             static_cast<std::size_t>(std::min<std::uint64_t>(place - read_, skipped.size()))) == 0)
      return;
}

InputFile::Length InputFile::length() {
  if (gzdirect(file_.get()) != 0) {
    seek(0);
    return {size_, false};
  }
  Length length;
  try {
    seek(std::numeric_limits<std::uint64_t>::max());
  } catch (const CutFile&) {
    length.cut = true;
  }
  length.bytes = read_;
  rewind();
  return length;
}

void InputFile::rewind() {
  if (gzrewind(file_.get()) != 0) throw InputError(fmt::format("{}: cannot read this file again", name_));
  read_ = 0;
}

}  // namespace kds
