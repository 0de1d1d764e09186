#pragma once
// Molecules of topologies that list bonds: residues in sequence that bonds connect.

#include <cstddef>
#include <vector>

#include "motions/readers/structure_models.h"

namespace kds {

/// Finds which residues are bonded to the residue before them. Bonds between other residues, such as
/// disulfide bridges, do not count.
class BondedResidues {
 public:
  /// `residue_of` gives the residue of each atom, in ascending order.
  explicit BondedResidues(std::vector<std::size_t> residue_of);

  /// Adds a bond between two atoms, numbered from 0.
  void add(std::size_t one, std::size_t other);
  /// Returns whether a bond joins the residue to the one before it.
  [[nodiscard]] bool follows(std::size_t residue) const { return bonded_[residue]; }

 private:
  std::vector<std::size_t> residue_of_;
  std::vector<bool> bonded_;
};

/// Marks all residues of a molecule as polymer if one of them is a known monomer, so that caps such as ACE
/// and NME belong to the chain. The residues of a molecule must be consecutive, and molecules need different
/// names.
void mark_polymers(std::vector<StructureResidue>& residues);

}  // namespace kds
