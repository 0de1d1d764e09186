#pragma once
// Applies an atom selection (selection.h) to the residues of a structure. The syntax is that of gemmi and
// MMDB, extended by negative residue numbers. The syntax is parsed here because gemmi's own header
// (select.hpp) needs another library on Debian 12.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "motions/readers/structure_models.h"

namespace kds {

class AtomFilter {
 public:
  /// Parses an atom selection. Throws InputError naming `option`, here and later.
  explicit AtomFilter(const std::string& text, std::string_view option = "--select");

  /// Returns the atoms of the residue that are selected, in the order of the file. The first of alternate
  /// locations counts. Throws InputError naming `file` if the selection compares a number that the file does
  /// not give.
  [[nodiscard]] std::vector<const StructureAtom*> atoms_of(const std::string& file,
                                                           const StructureResidue& residue) const;
  /// Returns whether the selection has this atom of the residue, be it the first of its alternate locations
  /// or not. Throws InputError like atoms_of.
  [[nodiscard]] bool takes(const std::string& file, const StructureResidue& residue,
                           const StructureAtom& atom) const;

 private:
  struct Rules;
  std::shared_ptr<const Rules> rules_;
};

}  // namespace kds
