#pragma once
// Cuts the text of a PDB file into its models, each with the lines that name and place atoms, checked.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/readers/periodic.h"

namespace kds {

struct PdbModel {
  std::string_view text;     ///< from its first line on to the next model's
  std::size_t first_line;    ///< 1-based, of the file
  std::optional<Cell> cell;  ///< of a simulation box: CRYST1 with space group P 1 (or none)
};

struct PdbText {
  std::vector<PdbModel> models;
  bool ends_inside = false;  ///< all models but the last are closed by ENDMDL or END
};

/// Models begin at MODEL and end at ENDMDL, END or the next MODEL; atoms before any MODEL make one too.
/// The result looks into `text`.
[[nodiscard]] PdbText split_pdb_models(std::string_view text);

/// The ATOM, HETATM and TER lines of a model, with an atom's place in the model (from 0) for its serial
/// number. Throws InputError naming file and line if a line is too short or a coordinate is no number.
[[nodiscard]] std::string atom_lines(const std::string& file, const PdbModel& model);

}  // namespace kds
