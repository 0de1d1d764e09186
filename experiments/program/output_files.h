#pragma once
// Files that are there whole or not at all: written beside their place, then renamed into it.

#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <string_view>

#include "experiments/program/unfinished_file.h"

namespace kds {

/// Makes the directory with its parents and checks that files can be made in it, so that a run is not lost at
/// its end. Throws InputError naming the option and the path.
void ensure_directory(const std::filesystem::path& path, std::string_view option);

/// Checks, without a trace left behind, that `path` can be written later. Throws InputError likewise.
void ensure_writable_file(const std::filesystem::path& path, std::string_view option);

/// Throws InputError naming the path.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for content that comes piece by piece. Without commit() nothing is left, not even if the
/// program is interrupted.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  void commit();

 private:
  std::filesystem::path path_, temporary_;  ///< no temporary: a device or pipe, written straight
  std::optional<UnfinishedFile> unfinished_;
  std::ofstream stream_;
};

}  // namespace kds
