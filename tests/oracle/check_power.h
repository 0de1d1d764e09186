#pragma once
// Checks whether a list of cells is the regular triangulation of weighted points, in space or in the plane.

#include <string>
#include <vector>

#include "dump.h"
#include "report.h"
#include "scene.h"

namespace oracle {

struct PowerDiagram {
  std::vector<Cell> cells;       ///< ascending ids, sorted lines
  std::vector<unsigned> hidden;  ///< ascending
  int dimension = 3;             ///< dimension of the affine hull of the points
};

/// Computes CGAL's diagram from scratch, from the first `space` (2 or 3) coordinates. With `backwards`, beads
/// are inserted in reverse order.
[[nodiscard]] PowerDiagram static_power_diagram(const Frame& frame, int space, bool backwards = false);

/// A frame with several regular triangulations may show any of them, which is then proved cell by cell.
void check_power(const Frame& frame, int space, const PowerDiagram& dumped, const std::string& where,
                 Report& report);

}  // namespace oracle
