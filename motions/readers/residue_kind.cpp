#include "motions/readers/residue_kind.h"

#include <algorithm>
#include <gemmi/resinfo.hpp>

namespace kds {

namespace {

bool has_atom(const StructureResidue& residue, std::string_view name, gemmi::El element) {
  return std::any_of(residue.atoms.begin(), residue.atoms.end(),
                     [&](const StructureAtom& atom) { return atom.name == name && atom.element == element; });
}

}  // namespace

const StructureAtom* first_named(const StructureResidue& residue, std::string_view name) {
  for (const StructureAtom& atom : residue.atoms)
    if (atom.name == name) return &atom;
  return nullptr;
}

bool has_backbone(const StructureResidue& residue) {
  return first_named(residue, "N") != nullptr && first_named(residue, "CA") != nullptr &&
         first_named(residue, "C") != nullptr;
}

bool is_tabulated_monomer(const std::string& name) {
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(name);
  return info.found() && (info.is_amino_acid() || info.is_nucleic_acid());
}

ResidueKind kind_of(const StructureResidue& residue) {
  if (residue.entity == Entity::other) return ResidueKind::none;
  const bool said_to_be = residue.entity == Entity::polymer;
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(residue.name);
  if (info.is_water()) return ResidueKind::none;
  // A standard residue as HETATM is a free molecule in the buffer, unless the file says otherwise.
  if (!said_to_be && info.found() && info.is_standard() && residue.het) return ResidueKind::none;
  if (info.found() && info.is_amino_acid()) return ResidueKind::protein;
  if (info.found() && info.is_nucleic_acid()) return ResidueKind::nucleic;
  if (info.found() && !said_to_be) return ResidueKind::none;
  if (has_atom(residue, "CA", gemmi::El::C) || has_backbone(residue)) return ResidueKind::protein;
  if (has_atom(residue, "P", gemmi::El::P)) return ResidueKind::nucleic;
  return said_to_be ? ResidueKind::cap : ResidueKind::none;
}

}  // namespace kds
