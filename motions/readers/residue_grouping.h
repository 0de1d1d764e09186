#pragma once
// Groups the atoms of a model into residues, for all formats of structures.
//
// A block is a run of atoms with the same chain, molecule, number and name. A block becomes a residue of its
// own unless it completes an earlier residue. A block completes a residue with the same chain, molecule,
// number and name if the two have no atom in common (name and alternate location). This happens for alternate
// locations or hydrogens listed later in the file. A block that contains an atom twice begins a new residue
// at the repeated atom, so residues whose numbers restart, overflow or collide stay separate.

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "motions/readers/structure_models.h"

namespace kds {

class ResidueGrouping {
 public:
  /// Adds the next atom of the file. `residue` must have no atoms.
  void add(const StructureResidue& residue, StructureAtom atom);
  /// Returns the residues of all atoms added, in the order of their first atoms.
  [[nodiscard]] std::vector<StructureResidue> take();

 private:
  void finish_block();
  void place(std::vector<StructureAtom> atoms);

  StructureResidue block_;
  std::vector<StructureResidue> residues_;
  std::unordered_set<std::string> numbers_;              ///< by chain, molecule and number
  std::unordered_map<std::string, std::size_t> latest_;  ///< residue by chain, molecule, number and name
};

}  // namespace kds
