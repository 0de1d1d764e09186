#pragma once
// Formats of trajectories and topologies that other programs write and kds does not read.

#include <filesystem>

namespace kds {

/// Throws InputError if the file's ending belongs to such a format. The message names the program that
/// converts the format.
void refuse_unread_format(const std::filesystem::path& path);

}  // namespace kds
