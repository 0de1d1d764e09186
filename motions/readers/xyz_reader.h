#pragma once
// XYZ files, plain or gzipped. Each frame has a line with the number of atoms, a comment, and a line `symbol
// x y z` for each atom; further columns are ignored. A comment with key=value pairs (extended XYZ) gives the
// cell (Lattice, pbc) and other columns (Properties). Atoms must keep their symbols and ids in all frames.

#include <filesystem>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"

namespace kds {

[[nodiscard]] FramesOpened open_xyz(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace kds
