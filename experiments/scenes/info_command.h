#pragma once
// The options of `kds info`, and the beads that it lists.

#include <span>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/page/table.h"
#include "experiments/program/input_options.h"
#include "motions/base/bead.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/bead_name.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct InfoOptions : InputOptions, Destinations {  // results: info.json and info.csv
  ValidateOptions validate{.most_listed = 5};
  bool beads = false;  ///< report only which residue each bead is
};

[[nodiscard]] const OptionList<InfoOptions>& info_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] InfoOptions parse_info_options(const Arguments& arguments);

/// The residue and atom of a bead. They identify the beads that results name by number.
struct BeadRow {
  BeadId bead = 0;
  std::size_t necklace = 0;  ///< from 0, in the order of the scene
  BeadName name;             ///< empty if the file has no names
  double radius = 0;
};

/// Returns the rows. `radii` has one radius per bead in scene order.
[[nodiscard]] std::vector<BeadRow> bead_rows(std::span<const Trajectory> necklaces,
                                             std::span<const double> radii);
/// Returns the columns of JSON, CSV and the terminal.
[[nodiscard]] const Table<BeadRow>& bead_columns();

}  // namespace kds
