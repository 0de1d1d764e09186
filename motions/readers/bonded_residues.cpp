#include "motions/readers/bonded_residues.h"

#include <utility>

#include "motions/readers/residue_kind.h"

namespace kds {

BondedResidues::BondedResidues(std::vector<std::size_t> residue_of)
    : residue_of_(std::move(residue_of)), bonded_(residue_of_.empty() ? 0 : residue_of_.back() + 1, false) {}

void BondedResidues::add(std::size_t one, std::size_t other) {
  const std::size_t a = residue_of_.at(one), b = residue_of_.at(other);
  if (a + 1 == b) bonded_[b] = true;
  if (b + 1 == a) bonded_[a] = true;
}

void mark_polymers(std::vector<StructureResidue>& residues) {
  for (std::size_t begin = 0, end = 0; begin < residues.size(); begin = end) {
    bool is_polymer = false;
    for (end = begin; end < residues.size() && residues[end].molecule == residues[begin].molecule; ++end)
      is_polymer = is_polymer || is_tabulated_monomer(residues[end].name);
    for (std::size_t i = begin; is_polymer && i < end; ++i) residues[i].entity = Entity::polymer;
  }
}

}  // namespace kds
