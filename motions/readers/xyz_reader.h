#pragma once
// XYZ files, plain or gzipped: for each frame a line with the number of atoms, a comment, then a line an
// atom. The line is `symbol x y z`, and what follows is left unread. A comment with key=value pairs (extended
// XYZ) gives the cell (Lattice, pbc) and other columns (Properties). Atoms keep their symbols and ids in all
// frames.

#include <filesystem>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"

namespace kds {

[[nodiscard]] FramesOpened open_xyz(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace kds
