#pragma once
// LAMMPS dumps as text, plain or gzipped. Atoms are sorted by their ids, which may come in any order.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Returns whether a LAMMPS dump begins with these bytes.
[[nodiscard]] bool looks_like_lammps(std::string_view start);

/// Opens a LAMMPS dump. All frames must have the same atoms and columns. Throws InputError naming the file if
/// its units or columns are not read.
[[nodiscard]] std::unique_ptr<AtomFrames> open_lammps(const std::filesystem::path& path,
                                                      const ReadOptions& options);

}  // namespace kds
