#pragma once
// A finished file takes the place of another, of which everything but the content stays: owner, permissions,
// and the links that lead to it.

#include <csignal>
#include <filesystem>
#include <string>

namespace kds {

/// Catchable signals wait while it lives, of this thread's: what is begun is ended.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

/// Where a symbolic link leads, also to what is not there yet; any other path itself.
[[nodiscard]] std::filesystem::path link_target(const std::filesystem::path& path);

/// Throws InputError or OutputError where replace_file would fail for a reason that can be known: the place
/// is
/// a directory, no regular file, or a file that the system keeps as it is; it has other hard links and may
/// not be written; it is a symbolic link that leads into a circle, or where no file can be made.
void check_replaceable(const std::filesystem::path& place);

/// Moves the file at `finished` to `place`. A symbolic link there stays, and what it leads to is replaced. A
/// file that is there hands on its permissions and owner; one that has other hard links, or an owner that
/// cannot be handed on, or lies on another disk, is written into instead, once there is room for it. Throws
/// as fail_to_write does; `subject` begins the message.
void replace_file(const std::filesystem::path& finished, const std::filesystem::path& place,
                  const std::string& subject);

}  // namespace kds
