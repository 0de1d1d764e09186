#pragma once
// Molecules of topologies that list bonds: residues in sequence that bonds connect.

#include <cstddef>
#include <vector>

#include "motions/readers/structure_models.h"

namespace kds {

/// Finds which residues are bonded to the residue before them. Bonds between other residues, as disulfide
/// bridges, do not count.
class BondedResidues {
 public:
  /// `residue_of` gives the residue of each atom, in ascending order.
  explicit BondedResidues(std::vector<std::size_t> residue_of);

  /// Adds a bond between two atoms, numbered from 0.
  void add(std::size_t one, std::size_t other);
  [[nodiscard]] bool follows(std::size_t residue) const { return bonded_[residue]; }

 private:
  std::vector<std::size_t> residue_of_;
  std::vector<bool> bonded_;
};

/// Counts residues of no known kind (caps such as ACE and NME) to the polymer of their molecule. Each
/// molecule must have a name of its own and consecutive residues.
void tell_polymers(std::vector<StructureResidue>& residues);

}  // namespace kds
