#pragma once
// Reads XTC files, the compressed trajectories of GROMACS.
//
// Numbers are big-endian. A frame holds its magic number (1995, or 2023 if sizes have 64 bits), the number of
// atoms, step, time (ps) and box (nm), then the coordinates. Up to nine atoms have plain floats.
//
// Coordinates of more atoms are integers: nanometres times a precision. Three integers x, y, z are packed
// into the number (x * sizes[1] + y) * sizes[2] + z, with as many bits as the product of the sizes has. Sizes
// above 2^24 are not packed.
//
// Atoms come in groups. The first atom of a group is packed with the sizes of the whole frame. A run of atoms
// may follow; each of these is packed as the difference from the atom before it, with a smaller size. A bit
// tells whether five more bits follow. These bits give the length of the run and may move the smaller size by
// one entry in a table. Without them the run is as long as the last one. The first two atoms of a group with
// a run are exchanged.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Returns whether a file that begins with these bytes is an XTC file.
[[nodiscard]] bool looks_like_xtc(std::string_view start);

/// Opens an XTC file. The frames are counted by their headers. Throws InputError naming the file.
[[nodiscard]] std::unique_ptr<AtomFrames> open_xtc(const std::filesystem::path& path,
                                                   const ReadOptions& options);

}  // namespace kds
