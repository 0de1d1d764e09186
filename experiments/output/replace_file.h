#pragma once
// Replaces the content of a file by a finished file. Owner, permissions and the links to the old file stay.

#include <csignal>
#include <filesystem>
#include <string>

namespace kds {

/// Blocks the catchable signals of this thread during its lifetime, so that a replacement that was begun is
/// completed.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

/// Returns the target of a symbolic link, even if the target does not exist yet. Returns any other path
/// unchanged.
[[nodiscard]] std::filesystem::path link_target(const std::filesystem::path& path);

/// Throws InputError or OutputError if replace_file would fail for a reason that is known beforehand:
/// - the place is a directory, is not a regular file, or is a file that the system protects from change;
/// - the place has other hard links and is not writable;
/// - the place is a symbolic link that leads into a cycle or to where no file can be made.
void check_replaceable(const std::filesystem::path& place);

/// Moves the file at `finished` to `place`. A symbolic link at `place` stays, and its target is replaced. The
/// new file gets the permissions and owner of the old file. The old file is overwritten instead, once there
/// is room for the content, if it has other hard links, if its owner cannot be passed on, or if it lies on
/// another disk. Throws as fail_to_write does. `subject` begins the message.
void replace_file(const std::filesystem::path& finished, const std::filesystem::path& place,
                  const std::string& subject);

}  // namespace kds
