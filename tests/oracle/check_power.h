#pragma once
// Is a list of cells the regular triangulation of weighted points, in space or in the plane?

#include <string>
#include <vector>

#include "dump.h"
#include "report.h"
#include "scene.h"

namespace oracle {

struct PowerDiagram {
  std::vector<Cell> cells;       ///< ascending ids, sorted lines
  std::vector<unsigned> hidden;  ///< ascending
  int dimension = 3;             ///< of the points' affine hull
};

/// CGAL's, from scratch, of the first `space` (2 or 3) coordinates; beads are inserted in another order where
/// `backwards`.
[[nodiscard]] PowerDiagram static_power_diagram(const Frame& frame, int space, bool backwards = false);

/// A frame with several regular triangulations may show any of them, which is proved cell by cell then.
void check_power(const Frame& frame, int space, const PowerDiagram& dumped, const std::string& where,
                 Report& report);

}  // namespace oracle
