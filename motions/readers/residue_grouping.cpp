#include "motions/readers/residue_grouping.h"

#include <algorithm>
#include <set>
#include <utility>

namespace kds {

namespace {

bool same_residue(const StructureResidue& a, const StructureResidue& b) {
  return a.number == b.number && a.name == b.name && a.chain == b.chain && a.sequence == b.sequence &&
         a.molecule == b.molecule;
}

std::string position_of(const StructureResidue& residue) {
  std::string key = residue.chain;
  for (const std::string* part : {&residue.molecule, &residue.sequence, &residue.number})
    key.append(1, '\0').append(*part);
  return key;
}

using Location = std::pair<std::string, char>;

Location location(const StructureAtom& atom) { return {atom.name, atom.alternate}; }

bool share_an_atom(const std::vector<StructureAtom>& a, const std::vector<StructureAtom>& b) {
  std::set<Location> held;
  for (const StructureAtom& atom : a) held.insert(location(atom));
  return std::any_of(b.begin(), b.end(),
                     [&](const StructureAtom& atom) { return held.count(location(atom)) > 0; });
}

// Finds where a new residue begins within a block: where its first atom or a backbone atom appears again. Two
// consecutive atoms of one name are copies of one atom, unless the block has no other names (a model of CA
// alone).
class Restarts {
 public:
  explicit Restarts(const std::vector<StructureAtom>& block)
      : one_name_(std::all_of(block.begin(), block.end(),
                              [&](const StructureAtom& atom) { return atom.name == block.front().name; })) {}

  bool at(const StructureAtom& atom) {
    const bool marks =
        seen_.empty() || atom.name == first_ || atom.name == "N" || atom.name == "CA" || atom.name == "P";
    const bool restarts =
        marks && !seen_.empty() && (one_name_ || atom.name != before_) && seen_.count(location(atom)) > 0;
    if (restarts) seen_.clear();
    if (seen_.empty()) first_ = atom.name;
    if (marks) seen_.insert(location(atom));
    before_ = atom.name;
    return restarts;
  }

 private:
  bool one_name_;
  std::string first_, before_;
  std::set<Location> seen_;
};

}  // namespace

void ResidueGrouping::add(const StructureResidue& residue, StructureAtom atom) {
  if (block_.atoms.empty() || !same_residue(block_, residue)) {
    finish_block();
    block_ = residue;
  }
  block_.atoms.push_back(std::move(atom));
}

void ResidueGrouping::finish_block() {
  if (block_.atoms.empty()) return;
  std::vector<StructureAtom> atoms = std::move(block_.atoms), part;
  block_.atoms.clear();
  Restarts restarts(atoms);
  for (StructureAtom& atom : atoms) {
    if (restarts.at(atom)) place(std::exchange(part, {}));
    part.push_back(std::move(atom));
  }
  place(std::move(part));
}

void ResidueGrouping::place(std::vector<StructureAtom> atoms) {
  std::string key = position_of(block_);
  const bool repeated = !numbers_.insert(key).second;
  const auto [found, is_new] = latest_.emplace(key.append(1, '\0').append(block_.name), residues_.size());
  if (!is_new) {
    std::vector<StructureAtom>& earlier = residues_[found->second].atoms;
    if (!share_an_atom(earlier, atoms)) {
      for (StructureAtom& atom : atoms) earlier.push_back(std::move(atom));
      return;
    }
    found->second = residues_.size();
  }
  residues_.push_back(block_);
  residues_.back().repeated = repeated;
  residues_.back().atoms = std::move(atoms);
}

std::vector<StructureResidue> ResidueGrouping::take() {
  finish_block();
  latest_.clear();
  numbers_.clear();
  return std::exchange(residues_, {});
}

}  // namespace kds
