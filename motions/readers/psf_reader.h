#pragma once
// PSF files of CHARMM, XPLOR, NAMD and VMD. These files name atoms and have no frames. Segments are chains.

#include <filesystem>
#include <memory>
#include <string_view>

namespace kds {

class StructureModels;

[[nodiscard]] bool looks_like_psf(std::string_view start);
/// Opens a file. Throws InputError if the file cannot be read or contains no atoms.
[[nodiscard]] std::unique_ptr<StructureModels> open_psf(const std::filesystem::path& path);

}  // namespace kds
