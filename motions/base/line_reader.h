#pragma once
// The lines of a file, one after the other, however long the file is. A byte order mark is left out.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "motions/base/input_file.h"

namespace kds {

class LineReader {
 public:
  /// Throws InputError naming the file.
  explicit LineReader(const std::filesystem::path& path) : file_(path) {}

  /// The next line, without its end, LF or CR LF; false at the end of the file. It lasts until the next call.
  /// Throws InputError naming file and line where one is longer than `longest`.
  [[nodiscard]] bool next(std::string_view& line);
  /// Of the line read last, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Whether the line read last ended with the file, not with a line end.
  [[nodiscard]] bool cut() const { return cut_; }
  /// Begins again with the first line.
  void rewind();
  [[nodiscard]] const std::string& name() const { return file_.name(); }

  static constexpr std::size_t longest = std::size_t{1} << 20U;

 private:
  [[nodiscard]] bool fill();

  InputFile file_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer and not yet handed out
  std::size_t number_ = 0;
  bool at_start_ = true;
  bool cut_ = false;
};

}  // namespace kds
