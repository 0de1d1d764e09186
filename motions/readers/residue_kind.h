#pragma once
// Whether a residue belongs to a polymer, by what the file says and by its name and atoms.

#include <string_view>

#include "motions/readers/structure_models.h"

namespace kds {

enum class ResidueKind {
  none,  ///< water, ligand, sugar, ion
  protein,
  nucleic,
  cap,  ///< part of a polymer, neither an amino acid nor a nucleotide
};

[[nodiscard]] ResidueKind kind_of(const StructureResidue& residue);

/// The first atom of this name, null if there is none.
[[nodiscard]] const StructureAtom* first_named(const StructureResidue& residue, std::string_view name);

/// Whether the residue has N, CA and C.
[[nodiscard]] bool has_backbone(const StructureResidue& residue);

/// Whether the name is that of an amino acid or a nucleotide in the table of residues.
[[nodiscard]] bool is_tabulated_monomer(const std::string& name);

}  // namespace kds
