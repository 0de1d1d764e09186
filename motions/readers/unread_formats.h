#pragma once
// Formats of trajectories and topologies that other programs write and kds does not read.

#include <filesystem>

namespace kds {

/// Throws InputError if the ending is that of such a format and no reader has it: the message names the
/// program that converts it.
void refuse_unread_format(const std::filesystem::path& path);

}  // namespace kds
