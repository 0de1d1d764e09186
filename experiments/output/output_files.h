#pragma once
// Files that appear whole or not at all: each is written beside its place, then renamed into it (atomic
// rename).

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

/// Checks before a run that the results can be written after it: that the directory exists or can be made,
/// and that the command can write files with these names in it. Leaves no trace. Throws an InputError that
/// names the option and the path.
void check_directory(const std::filesystem::path& path, std::string_view command, std::string_view option,
                     std::initializer_list<std::string_view> names = {});

/// Checks that `path` can be written later. Leaves no trace. Throws as check_directory does.
void ensure_writable_file(const std::filesystem::path& path, std::string_view option);

/// A file that appears only as a whole. Its content is written at once or piece by piece. Unless take_place()
/// is called, nothing remains, even if the program is interrupted. Throws an InputError or OutputError that
/// names the path.
class AtomicFile final : public Staged {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(std::filesystem::path path, std::string_view content);
  ~AtomicFile() override;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Throws if an earlier write failed, so that a long run can stop early.
  void check() const;
  void finish() override;
  void take_place() override;

 private:
  [[nodiscard]] std::string subject() const { return path_.string() + ": cannot write"; }

  std::filesystem::path path_;
  std::optional<Part> part_;  ///< empty for an output that is written directly
  int descriptor_ = -1;
  std::optional<DescriptorBuffer> buffer_;
  std::ostream stream_;
};

}  // namespace kds
