#pragma once
// Parses and checks the columns of an ATOM or HETATM line of a PDB file.

#include <string>
#include <string_view>

#include "motions/readers/structure_models.h"

namespace kds {

struct PdbAtom {
  StructureAtom atom;
  std::string residue;   ///< columns 18-20
  char column_21 = ' ';  ///< part of the residue's name or of the chain's, see open_pdb.cpp
  char chain = ' ';      ///< column 22
  std::string number;    ///< columns 23-27: residue number and insertion code
  std::string segment;   ///< columns 73-76
  bool het = false;
};

/// Returns the text in columns `first` to `last`, counted from 1, without surrounding blanks.
[[nodiscard]] std::string_view columns(std::string_view line, std::size_t first, std::size_t last);

/// Parses an ATOM or HETATM line. Throws InputError naming file and line if the line is too short or contains
/// a tab, or if a coordinate or the occupancy is not a number or overflows its columns.
[[nodiscard]] PdbAtom read_atom_line(const std::string& file, std::size_t line_number, std::string_view line);

}  // namespace kds
