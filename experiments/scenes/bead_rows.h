#pragma once
// Which residue each bead is: what results that name beads by their numbers are read with.

#include <span>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "motions/base/bead.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/bead_name.h"

namespace kds {

struct BeadRow {
  BeadId bead = 0;
  std::size_t necklace = 0;  ///< from 0, in the order of the scene
  BeadName name;             ///< empty where the file does not tell
  double radius = 0;
};

/// One radius a bead in scene order.
[[nodiscard]] std::vector<BeadRow> bead_rows(std::span<const Trajectory> necklaces,
                                             std::span<const double> radii);
[[nodiscard]] Json bead_rows_json(std::span<const BeadRow> rows);
[[nodiscard]] std::string bead_rows_csv(std::span<const BeadRow> rows);
[[nodiscard]] std::string bead_rows_table(std::span<const BeadRow> rows);

}  // namespace kds
