#include "motions/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"

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

// Returns a descriptor and the size of the file.
std::pair<int, std::uint64_t> open_regular(const std::string& name) {
  refuse_standard_input(name);
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
  return {descriptor, static_cast<std::uint64_t>(status.st_size)};
}

thread_local std::size_t restarts_in_thread = 0;

bool begins_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

}  // namespace

// The bytes as they lie on the disk, up to the size at opening.
class InputFile::OnDisk {
 public:
  explicit OnDisk(const std::string& name) : name_(name) {
    std::tie(descriptor_, size_) = open_regular(name);
  }
  ~OnDisk() { ::close(descriptor_); }
  OnDisk(const OnDisk&) = delete;
  OnDisk& operator=(const OnDisk&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  // Fills `to` from `offset` on, except at the end of the file.
  std::size_t read(std::uint64_t offset, char* to, std::size_t size) const {
    size = static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - std::min(offset, size_)));
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = ::pread(descriptor_, to + done, std::min<std::size_t>(size - done, 1U << 30U),
                                  static_cast<off_t>(offset + done));
      if (got == 0) break;
      if (got < 0 && errno == EINTR) continue;
      if (got < 0)
        throw InputError(
            fmt::format("{}: cannot read this file ({})", name_, std::generic_category().message(errno)));
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

 private:
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// The members of a gzipped file, unpacked.
class InputFile::Members {
 public:
  explicit Members(const OnDisk& disk) : disk_(disk), bytes_(std::size_t{1} << 16U) {
    constexpr int gzip_only = 16;
    if (inflateInit2(&stream_, MAX_WBITS + gzip_only) != Z_OK)
      throw InputError(fmt::format("{}: cannot unpack this file: memory is short", disk_.name()));
  }
  ~Members() { inflateEnd(&stream_); }
  Members(const Members&) = delete;
  Members& operator=(const Members&) = delete;

  // Fills `to`, except at the end of the file or before its cut.
  std::size_t read(char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size && !ended_) {
      if (!inside_) begin_member();
      if (ended_) break;
      if (!inside_ || (left() == 0 && !fill())) {  // the file is truncated
        if (done > 0) break;
        fail_cut();
      }
      stream_.next_in = reinterpret_cast<Bytef*>(bytes_.data() + begin_);
      stream_.avail_in = static_cast<uInt>(left());
      stream_.next_out = reinterpret_cast<Bytef*>(to + done);
      stream_.avail_out = static_cast<uInt>(size - done);
      const int code = inflate(&stream_, Z_NO_FLUSH);
      begin_ = end_ - stream_.avail_in;
      done = size - stream_.avail_out;
      if (code == Z_STREAM_END)
        inside_ = false;
      else if (code != Z_OK && code != Z_BUF_ERROR)
        throw InputError(fmt::format("{}: the gzipped data are damaged at byte {} ({})", disk_.name(),
                                     offset(), stream_.msg == nullptr ? zError(code) : stream_.msg));
    }
    return done;
  }

  void rewind() {
    filled_ = begin_ = end_ = 0;
    inside_ = ended_ = false;
  }

 private:
  [[nodiscard]] std::size_t left() const { return end_ - begin_; }
  // The byte of the file that is unpacked next.
  [[nodiscard]] std::uint64_t offset() const { return filled_ - left(); }

  // Appends further bytes to those that are left; returns false at the end of the file.
  bool fill() {
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(begin_),
              bytes_.begin() + static_cast<std::ptrdiff_t>(end_), bytes_.begin());
    end_ -= begin_;
    begin_ = 0;
    const std::size_t got = disk_.read(filled_, bytes_.data() + end_, bytes_.size() - end_);
    end_ += got;
    filled_ += got;
    return got > 0;
  }

  [[noreturn]] void fail_cut() const {
    throw CutFile(fmt::format("{}: cannot read this file to its end: the gzipped file is cut off at byte {}",
                              disk_.name(), filled_));
  }

  // Finds the next member, or the end of the file; finds neither in a file that is cut off.
  void begin_member() {
    while (left() < 2 && fill()) {
    }
    if (begins_gzip({bytes_.data() + begin_, left()})) {
      inflateReset(&stream_);
      inside_ = true;
      return;
    }
    if (left() == 1 && bytes_[begin_] == '\x1F') return;
    const std::uint64_t behind = offset();
    for (; left() > 0 || fill(); ++begin_)
      if (bytes_[begin_] != '\0')
        throw InputError(fmt::format(
            "{}: expected the end of the file or another gzip member at byte {}, found {} at byte {}",
            disk_.name(), behind, offset() == behind ? "other data" : "zeros and then other data", offset()));
    ended_ = true;
  }

  const OnDisk& disk_;
  z_stream stream_{};
  std::vector<char> bytes_;
  std::size_t begin_ = 0, end_ = 0;  // the part of `bytes_` that is not yet unpacked
  std::uint64_t filled_ = 0;         // bytes of the file read so far
  bool inside_ = false;              // inside a gzip member
  bool ended_ = false;
};

std::size_t byte_order_mark(std::string_view start, const std::string& file) {
  if (start.starts_with("\xEF\xBB\xBF")) return 3;
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
    throw InputError(fmt::format("{}: this text is UTF-16, expected ASCII or UTF-8", file));
  return 0;
}

void refuse_standard_input(const std::filesystem::path& path) {
  if (path == "-")
    throw InputError("-: standard input is not read; give the path of a file (./- for a file of this name)");
}

void require_regular_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw InputError(fmt::format("{}: cannot open this file", path.string()));
  check_kind(path.string(), status.st_mode);
}

InputFile::InputFile(const std::filesystem::path& path)
    : name_(path.string()),
      disk_(new OnDisk(name_), [](OnDisk* disk) { delete disk; }),
      packed_(nullptr, [](Members* members) { delete members; }) {
  std::array<char, 2> start{};
  if (begins_gzip({start.data(), disk_->read(0, start.data(), start.size())}))
    packed_.reset(new Members(*disk_));
}

std::size_t InputFile::read(char* to, std::size_t size) {
  size = std::min<std::size_t>(size, 1U << 30U);
  std::size_t got = 0;
  if (!packed_) {
    got = disk_->read(read_, to, size);
  } else if (read_ < unpacked_) {
    const auto left = static_cast<std::size_t>(unpacked_ - read_);
    got = std::min(size, left);
    std::copy_n(behind_.end() - static_cast<std::ptrdiff_t>(left), got, to);
  } else {
    got = unpack(to, size);
  }
  read_ += got;
  return got;
}

// Unpacks the next bytes and keeps the last ones.
std::size_t InputFile::unpack(char* to, std::size_t size) {
  const std::size_t got = packed_->read(to, size);
  if (unpacked_ == 0 && begins_gzip({to, got}))
    throw InputError(fmt::format("{}: this file is compressed twice; unpack it once with gunzip", name_));
  unpacked_ += got;
  if (unpacked_ > most_unpacked && unpacked_ / most_ratio > disk_->size())
    throw InputError(fmt::format("{}: unpacks to more than {} times its size, more than coordinates can",
                                 name_, most_ratio));
  const std::size_t kept = std::min(got, kept_behind);
  const std::size_t dropped = behind_.size() + kept - std::min(behind_.size() + kept, kept_behind);
  behind_.erase(behind_.begin(), behind_.begin() + static_cast<std::ptrdiff_t>(dropped));
  behind_.insert(behind_.end(), to + (got - kept), to + got);
  return got;
}

void InputFile::seek(std::uint64_t offset) {
  if (offset == read_) return;
  if (!packed_) {
    read_ = std::min(offset, disk_->size());
    return;
  }
  if (offset < unpacked_ - behind_.size()) rewind();
  read_ = std::min(offset, unpacked_);
  std::array<char, 1 << 15> skipped;
  while (read_ < offset)
    if (read(skipped.data(),
             static_cast<std::size_t>(std::min<std::uint64_t>(offset - read_, skipped.size()))) == 0)
      return;
}

bool InputFile::read_at(std::uint64_t offset, char* to, std::size_t size) try {
  seek(offset);
  if (read_ != offset) return false;
  while (size > 0) {
    const std::size_t got = read(to, size);
    if (got == 0) return false;
    to += got;
    size -= got;
  }
  return true;
} catch (const CutFile&) {
  return false;
}

InputFile::Length InputFile::length() {
  if (!packed_) {
    rewind();
    return {disk_->size(), false};
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
  if (packed_ && unpacked_ > 0) {
    packed_->rewind();
    ++restarts_in_thread;
  }
  read_ = unpacked_ = 0;
  behind_.clear();
}

std::size_t InputFile::restarts() { return restarts_in_thread; }

bool LineReader::next(std::string_view& line) {
  for (std::size_t searched = 0;;) {
    const std::string_view left(buffer_.data() + begin_, end_ - begin_);
    const std::size_t length = left.find('\n', searched);
    if (std::min(length, left.size()) > longest)
      throw InputError(fmt::format("{}:{}: this line is longer than {} characters, the limit of this format",
                                   name(), number_ + 1, longest));
    if (length != std::string_view::npos) {
      line = left.substr(0, length);
      begin_ += length + 1;
      cut_ = false;
      break;
    }
    searched = left.size();
    if (fill()) continue;
    if (left.empty()) return false;
    line = {buffer_.data() + begin_, end_ - begin_};
    begin_ = end_;
    cut_ = true;
    break;
  }
  ++number_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

// Moves the unread text to the front of the buffer and reads more. Returns false at the end of the file.
bool LineReader::fill() {
  constexpr std::size_t piece = std::size_t{1} << 16U;
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + piece) buffer_.resize(end_ + piece);
  const std::size_t got = file_.read(buffer_.data() + end_, piece);
  end_ += got;
  if (at_start_ && end_ >= 3) {
    begin_ = byte_order_mark({buffer_.data(), end_}, name());
    at_start_ = false;
  }
  return got > 0;
}

void LineReader::rewind() {
  file_.rewind();
  begin_ = end_ = number_ = 0;
  at_start_ = true;
  cut_ = false;
}

void LineReader::seek(std::uint64_t offset, std::size_t number) {
  if (offset == 0) return rewind();
  const std::uint64_t in_memory = file_.offset() - end_;
  if (in_memory <= offset && offset <= file_.offset()) {
    begin_ = static_cast<std::size_t>(offset - in_memory);
  } else {
    file_.seek(offset);
    begin_ = end_ = 0;
  }
  number_ = number - 1;
  at_start_ = false;
  cut_ = false;
}

}  // namespace kds
