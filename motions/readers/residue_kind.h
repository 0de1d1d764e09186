#pragma once
// Decides whether a residue belongs to a polymer, from what the file says and from its name and atoms.

#include <string>
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

/// Returns whether the residue is a water, by its name in the PDB or in simulations (SOL, TIP3, W).
[[nodiscard]] bool is_water(const std::string& name);

/// Returns whether the residue is one of Martini's amino acids, whose beads have no element.
[[nodiscard]] bool is_martini(const StructureResidue& residue);

/// Returns whether the residue is a cap at an end of a protein chain, but no amino acid.
[[nodiscard]] bool is_cap(const std::string& name);

/// Returns whether the name is that of a massless site: LP*, EP*, M and MW; M* in amino acids, nucleotides
/// and waters; OM in waters; and, for a Drude particle, D with the name of a heavier atom of the residue.
[[nodiscard]] bool names_site(const StructureResidue& residue, const std::string& name);

/// Returns whether the atom is a massless site, that is a lone pair, a virtual site or a Drude particle. Its
/// mass decides, otherwise the element that the file gives, otherwise its name.
[[nodiscard]] bool is_site(const StructureResidue& residue, const StructureAtom& atom);

/// Returns the element that the file gives for the atom; X for massless sites and beads of Martini. If the
/// file gives none, a name in the wrong column would turn CA into calcium and HG into mercury. An atom of a
/// chain whose element would be unusual there therefore gets the element of its name's first letter.
[[nodiscard]] gemmi::Element element_of(const StructureResidue& residue, const StructureAtom& atom);

/// Returns whether the name is that of an amino acid or a nucleotide in the table of residues, or their name
/// in AMBER, CHARMM or GROMACS (HSD, CYX, DA5).
[[nodiscard]] bool is_tabulated_monomer(const std::string& name);

}  // namespace kds
