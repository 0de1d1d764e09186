#pragma once
// Reads XTC files, the compressed trajectories of GROMACS.
//
// Numbers are big-endian. A frame holds its magic number (1995, or 2023 if sizes have 64 bits), the number of
// atoms, step, time (ps) and box (nm), then the coordinates. Up to nine atoms have plain floats.
//
// Coordinates of more atoms are integers: nanometres times a precision. They are packed with a radix: the
// number (x * sizes[1] + y) * sizes[2] + z in as many bits as the product of the sizes has. Atoms come in
// groups. The first atom of a group is packed with the sizes of the whole frame. A bit tells whether a run
// follows whose length differs from the last one. The atoms of the run are packed as differences from the
// atom before them, with a smaller size that may change by one place in a table after each group. The first
// two atoms of a group with a run are exchanged, which suits water.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Returns whether a file that begins with these bytes is an XTC file.
[[nodiscard]] bool looks_like_xtc(std::string_view start);

/// Opens an XTC file. Its frames are counted by their headers. Throws InputError naming the file.
[[nodiscard]] std::unique_ptr<AtomFrames> open_xtc(const std::filesystem::path& path,
                                                   const ReadOptions& options);

}  // namespace kds
