#include "experiments/output/straight_output.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "experiments/output/output_error.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

// Returns the descriptor of this program to which the path leads, if a link on the way lies in /proc/self/fd.
// The text of such a link need not be a path. If a file behind it were opened again, it would be written from
// its beginning, over the text that standard output has already written.
std::optional<int> descriptor_behind(fs::path path) {
  std::error_code error;
  const fs::path descriptors = fs::canonical("/proc/self/fd", error);
  if (error) return std::nullopt;
  constexpr int most_links = 40;
  for (int links = 0; links < most_links; ++links) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (fs::weakly_canonical(folder, error) == descriptors && !error) {
      const std::string name = path.filename().string();
      int number = -1;
      const auto [end, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
      return wrong == std::errc() && end == name.data() + name.size() && number >= 0 ? std::optional(number)
                                                                                     : std::nullopt;
    }
    if (!fs::is_symlink(path, error)) return std::nullopt;
    const fs::path target = fs::read_symlink(path, error);
    if (error) return std::nullopt;
    path = target.is_absolute() ? target : folder / target;
  }
  return std::nullopt;
}

}  // namespace

bool is_straight_output(const fs::path& path, const std::string& subject) {
  if (const auto descriptor = descriptor_behind(path)) {
    const int flags = ::fcntl(*descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
      throw InputError(fmt::format("{}: this descriptor is not open for writing", subject));
    return true;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_fifo(status))
    throw InputError(
        fmt::format("{}: is a named pipe, expected a file, a device or, for a pipe, /dev/stdout", subject));
  if (fs::is_socket(status))
    throw InputError(fmt::format("{}: is a socket, expected a file or a device", subject));
  return fs::is_character_file(status) || fs::is_block_file(status);
}

int open_straight_output(const fs::path& path, const std::string& subject) {
  const auto own = descriptor_behind(path);
  const int descriptor = own ? ::fcntl(*own, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(subject, errno);
  return descriptor;
}

}  // namespace kds
