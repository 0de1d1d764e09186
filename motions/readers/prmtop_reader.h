#pragma once
// Topologies of AMBER (prmtop, parm7). These files name atoms and have no frames or chains. Residues in
// sequence that a bond connects belong to one molecule (--chain 2 reads the second one). Numbers of residues
// count from 1.

#include <filesystem>
#include <memory>
#include <string_view>

namespace kds {

class StructureModels;

[[nodiscard]] bool looks_like_prmtop(std::string_view start);
/// Opens a file. Throws InputError if the file cannot be read or contains no atoms.
[[nodiscard]] std::unique_ptr<StructureModels> open_prmtop(const std::filesystem::path& path);

}  // namespace kds
