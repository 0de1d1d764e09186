#pragma once
// Outputs that are written as they come, into what is there, and not by a file that takes their place:
// devices, and what a descriptor of this program leads to (/dev/stdout, /dev/fd/3), be it a pipe, a socket or
// a file that is open there.

#include <filesystem>
#include <string>

namespace kds {

/// Throws InputError, beginning with `subject`, where the path leads to what nothing can be written to: a
/// named pipe, which waits for somebody to read it; a socket; a descriptor that is closed or only read from.
[[nodiscard]] bool is_straight_output(const std::filesystem::path& path, const std::string& subject);

/// A descriptor of it, of the caller's. Throws as fail_to_write does.
[[nodiscard]] int open_straight_output(const std::filesystem::path& path, const std::string& subject);

}  // namespace kds
