#pragma once
// Reads TRR files, the full-precision trajectories of GROMACS.
//
// Numbers are big-endian. A frame holds the magic number 1993 and the text GMX_trn_file, 13 integers (the
// sizes of what follows in bytes, the number of atoms, the step), time (ps) and lambda, then the box (nm),
// two tensors, positions (nm), velocities and forces, each unless its size is 0. All reals have single or
// double precision, which follows from the sizes. Doubles are rounded to floats, as mdtraj and MDAnalysis do.
// Velocities are read if the options ask for them; a frame may have none.
//
// Frames without positions hold velocities or forces only. Such frames are left out with a note.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Returns whether a file that begins with these bytes is a TRR file.
[[nodiscard]] bool looks_like_trr(std::string_view start);

/// Opens a TRR file. The frames are counted by their headers. Throws InputError naming the file.
[[nodiscard]] std::unique_ptr<AtomFrames> open_trr(const std::filesystem::path& path,
                                                   const ReadOptions& options);

}  // namespace kds
