#pragma once
// Which atoms of a structure are the beads of a necklace.
//
// A chain consists of molecules, which TER, segments (PDB) or label_asym_id (mmCIF) tell apart. `--chain`
// names a chain, or a molecule by its number: A.2 is the second molecule of chain A, 2 the second one without
// a chain name. Only molecules with amino acids or nucleotides have numbers. A chain's own name goes before
// that of a molecule.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"
#include "motions/readers/structure_models.h"

namespace kds {

struct SelectedAtom {
  const StructureAtom* atom;
  std::string element;
  std::string name;  ///< "CA of ALA 12 in chain A": tells models with other atoms apart
};

struct SelectedChains {
  std::vector<SelectedAtom> atoms;
  std::vector<ChainRead> chains;
  std::vector<std::string> notes;  ///< on residues and chains that are left out or guessed, a line each
};

/// Returns the beads of the chains in `list`, a list between commas, in its order. Without a list, returns
/// those of the first chain with amino acids, or else of the first chain with nucleotides.
///
/// Residues of a chain count wherever they stand in the file, unless they are waters, ligands or sugars. If
/// a chain has no other residues, `all` reads these. The first of alternate locations counts, and the first
/// of two residues that are alternates.
///
/// Throws InputError naming file and option if a name is not in the model or listed twice, or nothing is
/// selected.
[[nodiscard]] SelectedChains select_chains(const std::string& file, const StructureModel& model,
                                           Selection selection, const std::optional<std::string>& list);

/// Van der Waals radii; empty where an element is unknown.
[[nodiscard]] std::vector<double> element_radii_of(const std::vector<SelectedAtom>& atoms);

}  // namespace kds
