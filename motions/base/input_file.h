#pragma once
// A regular file, unpacked while it is read if it is gzipped. The amount read is bounded: by the size that a
// plain file has when it is opened, and by a limit for the unpacked size of a gzipped one.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "motions/base/input_error.h"

struct gzFile_s;

namespace kds {

/// Throws InputError where the path is no regular file: pipes and devices need not end.
void require_regular_file(const std::filesystem::path& path);

/// A gzipped file ends before its last byte: the download or the copy was cut off.
class CutFile : public InputError {
 public:
  using InputError::InputError;
};

/// Returns the length of the UTF-8 byte order mark at the start of a text, 0 if there is none. Throws
/// InputError naming the file if the text is UTF-16.
[[nodiscard]] std::size_t byte_order_mark(std::string_view start, const std::string& file);

class InputFile {
 public:
  /// Throws InputError naming the file; never waits for a pipe's other end.
  explicit InputFile(const std::filesystem::path& path);

  /// Reads at most `size` bytes; returns 0 only at the end. Throws CutFile at the end of a gzipped file that
  /// is cut off, and InputError if the file cannot be read or unpacks to more than both `most_unpacked` and
  /// `most_ratio` times its size.
  [[nodiscard]] std::size_t read(char* to, std::size_t size);
  /// Continues at this byte of the unpacked file, or at its end. Quick in plain files. A gzipped file is
  /// unpacked up to that byte, from the start if the byte lies before the present place.
  void seek(std::uint64_t place);
  /// The byte that is read next.
  [[nodiscard]] std::uint64_t place() const { return read_; }
  struct Length {
    std::uint64_t bytes = 0;  ///< of the unpacked file
    bool cut = false;         ///< the gzipped file is cut off behind them
  };
  /// Returns the length, and continues at the first byte. A gzipped file is unpacked once for it.
  [[nodiscard]] Length length();
  /// Begins again with the first byte.
  void rewind();
  [[nodiscard]] const std::string& name() const { return name_; }

  static constexpr std::uint64_t most_unpacked = std::uint64_t{1} << 26U;
  static constexpr std::uint64_t most_ratio = 100;

 private:
  std::string name_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
  std::uint64_t size_ = 0;  ///< as it lies on the disk
  std::uint64_t read_ = 0;
};

}  // namespace kds
