#pragma once
// XYZ files: for each frame a line with the number of atoms, a comment, then a line `symbol x y z` an atom.
// What follows on a line is left unread. A comment with Lattice="..." (extended XYZ) gives the cell.

#include <filesystem>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"

namespace kds {

[[nodiscard]] FramesOpened open_xyz(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace kds
