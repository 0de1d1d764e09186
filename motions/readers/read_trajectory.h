#pragma once
// Reads necklaces, one unless several chains are asked for: the format is told by the file's ending (.pdb
// .ent .cif .mmcif [.gz], .dcd, .xyz).

#include <filesystem>
#include <vector>

#include "motions/frames/trajectory.h"
#include "motions/readers/read_options.h"

namespace kds {

/// The beads are made whole where the file gives a periodic cell, and chain breaks are looked for where
/// consecutive beads are meant to be bonded (not for `all` atoms of known residues). Throws InputError naming
/// the file and, where it applies, the frame, bead or option at fault.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for as many chains as `options` name, a necklace each, in that order.
[[nodiscard]] std::vector<Trajectory> read_trajectories(const std::filesystem::path& path,
                                                        const ReadOptions& options = {});

}  // namespace kds
