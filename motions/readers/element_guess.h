#pragma once
// Elements of atoms in formats that do not name them.

#include <optional>
#include <string>
#include <vector>

#include "motions/readers/structure_models.h"

namespace kds {

/// Sets the element of each atom from its name: the first letter, or the whole name of an ion and of metals
/// and halogens outside of polymers. Beads of coarse models get no element.
void guess_elements_by_name(StructureResidue& residue);

/// Sets the element of each atom whose element is not given to the one whose mass is within 0.2 of its own,
/// if the atom's name begins with the letter of that element or the atom is alone in its residue. Otherwise
/// the name gives the element, because united atoms (CH3) and hydrogens that took a part of their neighbour's
/// mass have masses of their own. An atom whose mass is below 0.9 is a massless site, unless all masses are
/// 0. `masses` are by index. Returns a note if elements were taken from names.
[[nodiscard]] std::optional<std::string> set_elements_by_mass(std::vector<StructureResidue>& residues,
                                                              const std::vector<double>& masses);

}  // namespace kds
