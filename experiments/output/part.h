#pragma once
// A hidden file or folder beside the place of a result in the making, .kds-PROCESS-NUMBER.part: gone with the
// object, with the program if the user stops it, and, where the program was killed, with the next run that
// writes there.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "experiments/output/unfinished_file.h"

namespace kds {

class Part {
 public:
  enum class Kind { file, folder };
  /// Throws as fail_to_write does; `subject` begins the message.
  Part(const std::filesystem::path& directory, Kind kind, const std::string& subject);
  ~Part();
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Where the next file of a folder is to be made, which goes with the folder: file(0), file(1), ...
  [[nodiscard]] std::filesystem::path add_file();
  [[nodiscard]] std::filesystem::path file(std::uint64_t number) const {
    return path_ / std::to_string(number);
  }
  /// The file takes its place, as replace_file has it, while signals wait. Throws likewise.
  void become(const std::filesystem::path& place, const std::string& subject);

 private:
  std::filesystem::path path_;
  std::uint64_t files_ = 0;
  int descriptor_ = -1;  ///< open and locked, so that others know that it is in use
  std::optional<UnfinishedFile> unfinished_;
};

/// Removes the parts that killed programs left in the directory.
void clear_stale_parts(const std::filesystem::path& directory);

}  // namespace kds
