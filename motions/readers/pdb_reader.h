#pragma once
// Formats whose atoms have residues: PDB, mmCIF and their relatives, plain or gzipped. The models of a file
// are the frames. The cell of a crystal is not a simulation box. A cell is therefore used only if the file
// has several models, the space group is P 1, and the lengths are above 1 angstrom. GRO files have boxes.
//
// A reader of such a format is one function that opens the models of a file (structure_models.h) and one line
// of registration (reader_registry.cpp).

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "motions/readers/reader_registry.h"
#include "motions/readers/topology.h"

namespace kds {

class StructureModels;

/// Opens the models of a file. Throws InputError if the file cannot be read or contains no atoms.
using OpenModels = std::unique_ptr<StructureModels> (*)(const std::filesystem::path& path);

/// Returns the specification of a format with residues: its models are frames, and it names atoms.
[[nodiscard]] ReaderSpec structure_format(std::string name, std::vector<std::string> endings,
                                          std::function<bool(std::string_view)> recognises, OpenModels open);
/// Returns the specification of a format that names atoms but has no frames.
[[nodiscard]] ReaderSpec topology_format(std::string name, std::vector<std::string> endings,
                                         std::function<bool(std::string_view)> recognises, OpenModels open);

[[nodiscard]] bool looks_like_pdb(std::string_view start);
[[nodiscard]] bool looks_like_mmcif(std::string_view start);
std::unique_ptr<StructureModels> open_pdb(const std::filesystem::path& path);
std::unique_ptr<StructureModels> open_mmcif(const std::filesystem::path& path);

}  // namespace kds
