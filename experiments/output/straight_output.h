#pragma once
// Outputs that are written directly, without an atomic rename: devices, and paths that lead to a descriptor
// of this program (/dev/stdout, /dev/fd/3). The descriptor may belong to a pipe, a socket or an open file.

#include <filesystem>
#include <string>

namespace kds {

/// Returns whether the path is a direct output. Throws an InputError that begins with `subject` if the path
/// cannot be written to: a named pipe, which blocks until another program reads it, a socket, or a descriptor
/// that is closed or open only for reading.
[[nodiscard]] bool is_straight_output(const std::filesystem::path& path, const std::string& subject);

/// Opens the output and returns a descriptor, which the caller owns. Throws as fail_to_write does.
[[nodiscard]] int open_straight_output(const std::filesystem::path& path, const std::string& subject);

}  // namespace kds
