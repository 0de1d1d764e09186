#pragma once
// DCD files (CHARMM, NAMD, LAMMPS), plain or gzipped: both byte orders, 32- or 64-bit markers, with or
// without unit cell, fourth coordinate and fixed atoms. Only the requested frames are read; in a gzipped file
// the frames before them are unpacked too. The number of frames is computed from the file's size. The count
// in the header is often wrong; then a warning says so.

#include <filesystem>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Opens a DCD file. The topology must either name all atoms of the DCD in their order, or its selected beads
/// must be the DCD's atoms.
[[nodiscard]] FramesOpened open_dcd(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace kds
