#pragma once
// XYZ files, plain or gzipped. Each frame has a line with the number of atoms, a comment, and a line `symbol
// x y z` for each atom; further columns are ignored. A comment with key=value pairs (extended XYZ) gives the
// cell (Lattice, pbc) and other columns (Properties). Atoms must keep their symbols and ids in all frames.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"

namespace kds {

[[nodiscard]] bool looks_like_xyz(std::string_view start);
[[nodiscard]] std::unique_ptr<AtomFrames> open_xyz(const std::filesystem::path& path,
                                                   const ReadOptions& options);

}  // namespace kds
