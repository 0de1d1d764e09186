#pragma once
// Decides whether a residue belongs to a polymer, from what the file says and from its name and atoms.

#include <string_view>

#include "motions/readers/structure_models.h"

namespace kds {

enum class ResidueKind {
  none,  ///< water, ligand, sugar, ion
  protein,
  nucleic,
  cap,  ///< part of a polymer, but neither an amino acid nor a nucleotide
};

[[nodiscard]] ResidueKind kind_of(const StructureResidue& residue);

/// Returns the first atom of this name, or null.
[[nodiscard]] const StructureAtom* first_named(const StructureResidue& residue, std::string_view name);

/// Returns whether the residue has N, CA and C.
[[nodiscard]] bool has_backbone(const StructureResidue& residue);

/// Returns whether the name is that of an amino acid or a nucleotide in the table of residues.
[[nodiscard]] bool is_tabulated_monomer(const std::string& name);

}  // namespace kds
