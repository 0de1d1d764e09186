#pragma once
// Input files, plain or gzipped, read by bytes or by lines.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/input_error.h"

namespace kds {

/// Throws InputError if the path is `-`, which stands for standard input in other programs.
void refuse_standard_input(const std::filesystem::path& path);

/// Throws InputError if the path is not a regular file. Pipes and devices are rejected because they may never
/// end.
void require_regular_file(const std::filesystem::path& path);

/// Thrown if a gzipped file ends prematurely, for example after an interrupted download or copy.
class CutFile : public InputError {
 public:
  using InputError::InputError;
};

/// Returns the length of the UTF-8 byte order mark at the start of a text, 0 if there is none. Throws
/// InputError naming the file if the text is UTF-16.
[[nodiscard]] std::size_t byte_order_mark(std::string_view start, const std::string& file);

/// A regular file, unpacked while it is read if it is gzipped. The amount read is bounded by the size that
/// the file has when it is opened, and by a limit for the unpacked size of a gzipped one.
///
/// A gzipped file is a sequence of members, which are unpacked one after the other. Zeros may pad the file
/// after the last member. Anything else there is an error, because members that cannot be recognised would be
/// lost.
class InputFile {
 public:
  /// Opens the file. Throws InputError naming the file. Never blocks on a pipe.
  explicit InputFile(const std::filesystem::path& path);

  /// Reads at most `size` bytes; returns 0 only at the end. Throws CutFile at the end of a gzipped file that
  /// is cut off, and InputError if the file cannot be read, if its gzipped data are damaged, compressed twice
  /// or followed by other data, or if it unpacks to more than both `most_unpacked` and `most_ratio` times its
  /// size.
  [[nodiscard]] std::size_t read(char* to, std::size_t size);
  /// Continues at this byte of the unpacked file, or at its end. Fast for plain files. A gzipped file is
  /// unpacked up to that byte, from the start if the byte is more than `kept_behind` bytes before the last
  /// one unpacked.
  void seek(std::uint64_t offset);
  /// Reads `size` bytes from this byte on. Returns false if the file ends before them, also if a gzipped file
  /// is cut off there.
  [[nodiscard]] bool read_at(std::uint64_t offset, char* to, std::size_t size);
  /// Returns the position of the next byte.
  [[nodiscard]] std::uint64_t offset() const { return read_; }
  struct Length {
    std::uint64_t bytes = 0;  ///< length of the unpacked file
    bool cut = false;         ///< the gzipped file is truncated after these bytes
  };
  /// Returns the length, and continues at the first byte. A gzipped file is unpacked once to determine it.
  [[nodiscard]] Length length();
  /// Starts again at the first byte.
  void rewind();
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns whether the file is unpacked while it is read.
  [[nodiscard]] bool is_gzipped() const { return packed_ != nullptr; }

  /// Returns how often gzipped files have been unpacked again from the start in this thread, for tests.
  [[nodiscard]] static std::size_t restarts();

  static constexpr std::size_t kept_behind = std::size_t{1} << 12U;
  static constexpr std::uint64_t most_unpacked = std::uint64_t{1} << 26U;
  static constexpr std::uint64_t most_ratio = 100;

 private:
  [[nodiscard]] std::size_t unpack(char* to, std::size_t size);

  class OnDisk;
  class Members;

  std::string name_;
  std::unique_ptr<OnDisk, void (*)(OnDisk*)> disk_;
  std::unique_ptr<Members, void (*)(Members*)> packed_;  ///< null for a plain file
  std::uint64_t read_ = 0;
  std::uint64_t unpacked_ = 0;  ///< bytes of a gzipped file unpacked so far
  std::vector<char> behind_;    ///< the last of these, at most `kept_behind`
};

/// Reads the lines of a file of any length, one after the other. A byte order mark is skipped.
class LineReader {
 public:
  /// Opens the file. Throws InputError naming the file.
  explicit LineReader(const std::filesystem::path& path) : file_(path) {}

  /// Reads the next line without its line end (LF or CR LF). Returns false at the end of the file. `line` is
  /// valid until the next call. Throws InputError naming file and line if a line is longer than `longest`.
  [[nodiscard]] bool next(std::string_view& line);
  /// Returns the number of the line read last, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Returns whether the line read last ended at the end of the file, without a line end.
  [[nodiscard]] bool cut() const { return cut_; }
  /// Returns the position in the file of the next line, in bytes.
  [[nodiscard]] std::uint64_t offset() const { return file_.offset() - (end_ - begin_); }
  /// Starts again at the first line.
  void rewind();
  /// Continues at the line that begins at this byte and has this number. Takes no time if the line is in
  /// memory, as the next line is. A gzipped file is otherwise unpacked up to the line.
  void seek(std::uint64_t offset, std::size_t number);
  [[nodiscard]] const std::string& name() const { return file_.name(); }

  static constexpr std::size_t longest = std::size_t{1} << 20U;

 private:
  [[nodiscard]] bool fill();

  InputFile file_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< the unread part of the buffer
  std::size_t number_ = 0;
  bool at_start_ = true;
  bool cut_ = false;
};

}  // namespace kds
