#pragma once
// The residue and atom of each bead. They identify the beads that results name by number.

#include <span>
#include <string>
#include <vector>

#include "experiments/output/page/table.h"
#include "motions/base/bead.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/bead_name.h"

namespace kds {

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
