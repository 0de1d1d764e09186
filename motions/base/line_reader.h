#pragma once
// Reads the lines of a file of any length, one after the other. A byte order mark is skipped.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "motions/base/input_file.h"

namespace kds {

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
  [[nodiscard]] std::uint64_t place() const { return file_.place() - (end_ - begin_); }
  /// Starts again at the first line.
  void rewind();
  /// Continues at the line that begins at this byte and has this number. Takes no time if the line is in
  /// memory, as the next line is. A gzipped file is otherwise unpacked up to the line.
  void seek(std::uint64_t place, std::size_t number);
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
