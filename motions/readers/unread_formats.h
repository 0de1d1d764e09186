#pragma once
// Formats of trajectories and topologies that other programs write and kds does not read.

#include <filesystem>
#include <string_view>

namespace kds {

/// Throws InputError if `start`, the first bytes of the file, shows such a format. The message names the
/// format and the program that converts it.
void refuse_unread_content(const std::filesystem::path& path, std::string_view start);
/// Throws InputError if the file's ending is that of such a format.
void refuse_unread_ending(const std::filesystem::path& path);

}  // namespace kds
