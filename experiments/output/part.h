#pragma once
// A hidden file or folder, .kds-PROCESS-NUMBER.part, that lies beside the place of an unfinished result. The
// destructor removes it. It is also removed if the user stops the program. If the program is killed, the next
// run that writes there removes it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "experiments/output/unfinished_file.h"

namespace kds {

class Part {
 public:
  enum class Kind { file, folder };
  /// Throws as fail_to_write does. `subject` begins the message.
  Part(const std::filesystem::path& directory, Kind kind, const std::string& subject);
  ~Part();
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Returns the path for the next file of a folder: file(0), file(1), ... These files are removed with the
  /// folder.
  [[nodiscard]] std::filesystem::path add_file();
  [[nodiscard]] std::filesystem::path file(std::uint64_t number) const {
    return path_ / std::to_string(number);
  }
  /// Moves the file to `place` as replace_file does, with signals blocked. Throws as fail_to_write does.
  void become(const std::filesystem::path& place, const std::string& subject);

 private:
  std::filesystem::path path_;
  std::uint64_t files_ = 0;
  int descriptor_ = -1;  ///< open and locked, so that other programs see that the part is in use
  std::optional<UnfinishedFile> unfinished_;
};

/// Removes the parts that killed programs left in the directory.
void clear_stale_parts(const std::filesystem::path& directory);

}  // namespace kds
