#pragma once
// GRO files of GROMACS, with one or more frames. Lengths are in nanometres in the file.
//
// The file has no chains. Residues are divided into molecules (--chain 2 reads the second one): a molecule
// begins where the residue number goes down, where the kind of molecule changes (protein, nucleic acid,
// water, others), and after or before an atom that only the end of a chain has, as OXT, OC2, H3 or HO5'.

#include <filesystem>
#include <memory>
#include <string_view>

namespace kds {

class StructureModels;

[[nodiscard]] bool looks_like_gro(std::string_view start);
/// Opens a file. Throws InputError if the file cannot be read.
[[nodiscard]] std::unique_ptr<StructureModels> open_gro(const std::filesystem::path& path);

}  // namespace kds
