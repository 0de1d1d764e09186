#pragma once
// The comment line of an extended XYZ file: key=value pairs as specified by libAtoms/extxyz.
//
//   pair    key = value, with blanks around '=' or without
//   key     a bare or quoted string; Lattice, Properties and pbc in any case
//   value   a bare string, a string in single or double quotes with backslash escapes, or an array
//   array   [a, b, c], [[a, b, c], [d, e, f]], {a b c} or, in the old style, "a b c"; commas or blanks
//           separate its items
//
// Words without '=' are skipped: the comment of a plain XYZ file is any text. Other keys are skipped as well;
// a key that is one edit away from one of these three keys, or its singular or plural, is reported if that
// key is missing.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/frames/periodic.h"

namespace kds {

/// The columns of an atom's line, counted from 0.
struct XyzColumns {
  std::optional<std::size_t> species = 0;  ///< a symbol, a name or an atomic number
  std::size_t position = 1;                ///< the column of x; y and z follow
  std::optional<std::size_t> id;           ///< the column of an id that each atom keeps in all frames
  std::size_t count = 4;
  bool named = false;  ///< Properties is given: lines have exactly `count` columns, otherwise at least
                       ///< `count`
};

struct XyzComment {
  CellRead cell;
  XyzColumns columns;
  /// A key that probably means the lattice but is not supported, such as cell=.
  std::optional<std::string> near_lattice;
  /// Keys that are probably misspelt, as in latice=, for a message; empty if there are none.
  std::string misspelt;
};

/// Parses the comment line. Throws InputError, without the name of the file, if Lattice, Properties or pbc
/// cannot be parsed.
[[nodiscard]] XyzComment read_xyz_comment(std::string_view line);

/// Parses a number whose exponent may begin with e, E, d or D.
[[nodiscard]] std::optional<double> parse_fortran_double(std::string_view field);

}  // namespace kds
