#pragma once
// A regular file, decompressed while it is read if it is gzipped. The amount read is bounded: for a plain
// file by its size when it is opened, for a gzipped file by a limit on its unpacked size.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "motions/base/input_error.h"

struct gzFile_s;

namespace kds {

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

class InputFile {
 public:
  /// Opens the file. Throws InputError naming the file. Never blocks on a pipe.
  explicit InputFile(const std::filesystem::path& path);

  /// Reads at most `size` bytes. Returns 0 only at the end. Throws CutFile at the end of a truncated gzipped
  /// file. Throws InputError if the file cannot be read, or if its unpacked size exceeds both `most_unpacked`
  /// and `most_ratio` times its packed size.
  [[nodiscard]] std::size_t read(char* to, std::size_t size);
  /// Continues at this byte of the unpacked file, or at its end. Fast for plain files. A gzipped file is
  /// unpacked up to that byte, from the start if the byte is before the present position.
  void seek(std::uint64_t place);
  /// Returns the position of the next byte.
  [[nodiscard]] std::uint64_t place() const { return read_; }
  struct Length {
    std::uint64_t bytes = 0;  ///< length of the unpacked file
    bool cut = false;         ///< the gzipped file is truncated after these bytes
  };
  /// Returns the length, and continues at the first byte. A gzipped file is unpacked once to determine it.
  [[nodiscard]] Length length();
  /// Starts again at the first byte.
  void rewind();
  [[nodiscard]] const std::string& name() const { return name_; }

  static constexpr std::uint64_t most_unpacked = std::uint64_t{1} << 26U;
  static constexpr std::uint64_t most_ratio = 100;

 private:
  std::string name_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
  std::uint64_t size_ = 0;  ///< size on disk
  std::uint64_t read_ = 0;
};

}  // namespace kds
