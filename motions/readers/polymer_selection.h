#pragma once
// Which atoms of a structure are the beads of a necklace.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motions/readers/read_options.h"

namespace gemmi {
struct Atom;
struct Model;
}  // namespace gemmi

namespace kds {

struct SelectedAtom {
  const gemmi::Atom* atom;
  std::string element;
  std::string name;  ///< "CA of ALA 12 in chain A": tells models with other atoms apart
};

/// The beads of one chain, in its order. Residues of the chain count wherever they stand in the file, those
/// of waters, ligands and sugars do not; of alternate locations and of two residues at one position the first
/// counts. Throws InputError naming file and option if nothing is selected.
[[nodiscard]] std::vector<SelectedAtom> select_polymer_atoms(const std::string& file,
                                                             const gemmi::Model& model, Selection selection,
                                                             const std::string& chain);

/// The chains that a list between commas names, in its order; the default chain where there is none. Throws
/// InputError naming file and option where a name is empty, listed twice or not in the model.
[[nodiscard]] std::vector<std::string> chains_asked_for(const std::string& file, const gemmi::Model& model,
                                                        const std::optional<std::string>& list);

/// One line about the other polymer chains of the model and how to read them; none where there are none.
[[nodiscard]] std::optional<std::string> describe_unread_chains(const std::string& file,
                                                                const gemmi::Model& model,
                                                                const std::string& read, Selection selection);

/// Van der Waals radii; empty where an element is unknown.
[[nodiscard]] std::vector<double> element_radii_of(const std::vector<SelectedAtom>& atoms);

}  // namespace kds
