#pragma once
// CGAL's regular triangulation and alpha shape of exact points.

#include <array>
#include <span>
#include <vector>

#include "tests/support/judges/exact_checks.h"

namespace kds::test {

struct CgalCells {
  std::vector<std::array<BeadId, 4>> cells;  ///< finite cells, sorted; the beads of each ascend
  std::size_t visible = 0;
  bool valid = false;
};

/// Computes with rational numbers alone, which need no filter, interval arithmetic or rounding mode.
[[nodiscard]] CgalCells cgal_regular_cells(std::span<const ExactPoint> points);

/// Returns the simplices of CGAL's weighted alpha shape at alpha = 0 that are not exterior, sorted; the beads
/// of each ascend, and unused entries hold no_bead. Points are balls whose squared radii are their weights.
/// Computes with rational numbers where intervals leave a sign open. This takes 0.05 ms for six balls, and
/// half as long if all their numbers are doubles.
[[nodiscard]] std::vector<std::array<BeadId, 4>> cgal_alpha_complex(std::span<const ExactPoint> points);

}  // namespace kds::test
