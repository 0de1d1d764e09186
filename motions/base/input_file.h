#pragma once
// A file that is read: a regular one, unpacked if it is gzipped. What is read is bounded: by the size that a
// plain file has when it is opened, and by a limit for what a gzipped one unpacks to.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

struct gzFile_s;

namespace kds {

/// Throws InputError where the path is no regular file: pipes and devices need not end.
void require_regular_file(const std::filesystem::path& path);

class InputFile {
 public:
  /// Throws InputError naming the file; never waits for a pipe's other end.
  explicit InputFile(const std::filesystem::path& path);

  /// At most `size` bytes; 0 at the end only. Throws InputError where the file cannot be read on, and where
  /// it unpacks to more than both `most_unpacked` and `most_ratio` times its size.
  [[nodiscard]] std::size_t read(char* to, std::size_t size);
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
