#pragma once
// Files that are there whole or not at all: written beside their place, then renamed into it.

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "experiments/output/descriptor_buffer.h"
#include "experiments/output/part.h"
#include "experiments/output/staged.h"

namespace kds {

/// Checks, without a trace left behind, that the directory can be made, where it is none yet, and files of
/// these names be written there as results of the command: so that a run is not lost at its end. Throws
/// InputError naming the option and the path.
void check_directory(const std::filesystem::path& path, std::string_view command, std::string_view option,
                     std::initializer_list<std::string_view> names = {});

/// Checks, without a trace left behind, that `path` can be written later. Throws InputError likewise.
void ensure_writable_file(const std::filesystem::path& path, std::string_view option);

/// Its content comes at once or piece by piece. Without take_place() nothing is left, not even if the program
/// is interrupted. Throws InputError or OutputError naming the path.
class AtomicFile final : public Staged {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(std::filesystem::path path, std::string_view content);
  ~AtomicFile() override;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Throws where something could not be written: soon, and not after a long run.
  void check() const;
  void finish() override;
  void take_place() override;

 private:
  [[nodiscard]] std::string subject() const { return path_.string() + ": cannot write"; }

  std::filesystem::path path_;
  std::optional<Part> part_;  ///< none: an output that is written straight
  int descriptor_ = -1;
  std::optional<DescriptorBuffer> buffer_;
  std::ostream stream_;
};

}  // namespace kds
