#pragma once
// Selects the atoms of a structure that are the beads of a necklace.
//
// A chain consists of molecules, which TER, segments (PDB) or label_asym_id (mmCIF) distinguish. `--chain`
// names a chain, or a molecule by its number: A.2 is the second molecule of chain A, and 2 is the second
// molecule without a chain name. Only molecules with amino acids or nucleotides have numbers. The name of a
// chain takes precedence over that of a molecule.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"
#include "motions/readers/structure_models.h"

namespace kds {

struct SelectedAtom {
  const StructureAtom* atom;
  std::string element;
  std::string name;         ///< "CA of ALA 12 in chain A": detects models with different atoms
  std::uint8_t groups = 0;  ///< bit k: the atom is in group k
};

struct SelectedChains {
  std::vector<SelectedAtom> atoms;
  std::vector<ChainRead> chains;
  BondPaths bonds;                   ///< along the atoms
  std::vector<SelectedAtom> guides;  ///< the guides of `bonds`
  std::vector<std::string> notes;  ///< about residues and chains that are left out or guessed, one line each
  bool chain_like = true;          ///< consecutive beads are meant to be bonded
};

/// Returns the beads of the chains in the comma-separated `list`, in its order. Without a list, returns the
/// beads of the first chain with amino acids, otherwise of the first chain with nucleotides.
///
/// All residues of a chain count, wherever they are in the file, unless they are waters, ligands or sugars.
/// If a chain has only those, the selection `all` reads them. If an atom has alternate locations, the first
/// one is used; if two residues are alternates, the first one is used.
///
/// An atom selection (`Selection::atoms`) chooses from all residues, waters and ligands included. Without a
/// list, each chain with selected atoms is read. A chain without a name is read as its molecules, and its
/// other residues follow as one more chain. With a list, both must hold.
///
/// A group has the beads whose atoms meet its selection. The selections `backbone`, `ca`, `bb` and `p` hold
/// for atoms of polymers only. Groups neither add beads nor leave beads out, and a group may have no bead.
///
/// An atom follows the atom before it by bonds if both are in one residue or in consecutive residues of one
/// molecule of a polymer. The polymer's residues that an atom selection leaves out between two atoms give a
/// guide each: CA, BB, P, or the first atom. Any other atom begins a piece. A residue outside polymers is a
/// piece of its own, unless the file lists bonds.
///
/// Throws InputError naming file and option if a name is not in the model or is listed twice, or if nothing
/// is selected.
[[nodiscard]] SelectedChains select_chains(const std::string& file, const StructureModel& model,
                                           const Selection& selection, const std::optional<std::string>& list,
                                           std::span<const Selection> groups = {});

/// Returns the van der Waals radii of the atoms, or an empty vector if an element is unknown. Then `lack`
/// names the first such atom and the file.
[[nodiscard]] std::vector<double> element_radii_of(const std::string& file,
                                                   const std::vector<SelectedAtom>& atoms, std::string& lack);

}  // namespace kds
