#pragma once
// DCD files (CHARMM, NAMD, LAMMPS), plain or gzipped: both byte orders, 32- or 64-bit markers, with or
// without unit cell, fourth coordinate and fixed atoms. Only the requested frames are read; in a gzipped file
// the frames before them are unpacked too. The number of frames is computed from the file's size. The count
// in the header is often wrong; then a warning says so.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"

namespace kds {

[[nodiscard]] bool looks_like_dcd(std::string_view start);
[[nodiscard]] std::unique_ptr<AtomFrames> open_dcd(const std::filesystem::path& path,
                                                   const ReadOptions& options);

}  // namespace kds
