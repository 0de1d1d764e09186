#pragma once
// Reads necklaces: one, unless several chains are requested. The first bytes of the file determine the
// format, otherwise its ending does (reader_registry.h).

#include <filesystem>
#include <vector>

#include "motions/frames/trajectory.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Reads one necklace. If the file gives a periodic cell, the chain is made whole. Chain breaks are detected
/// if consecutive beads are meant to be bonded (not for `all` atoms of known residues). Throws InputError
/// naming the file and, if applicable, the frame, bead or option at fault.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a necklace for each chain that `options` names, in that order.
[[nodiscard]] std::vector<Trajectory> read_trajectories(const std::filesystem::path& path,
                                                        const ReadOptions& options = {});

}  // namespace kds
