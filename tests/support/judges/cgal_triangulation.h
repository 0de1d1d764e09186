#pragma once
// CGAL's regular triangulation over rational numbers, which needs no filter, interval arithmetic or rounding
// mode.

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

[[nodiscard]] CgalCells cgal_regular_cells(std::span<const ExactPoint> points);

/// Returns the simplices of CGAL's weighted alpha shape at alpha = 0 that are not exterior, sorted; the beads
/// of each ascend, and unused entries hold no_bead. Points are balls whose squared radii are their weights.
[[nodiscard]] std::vector<std::array<BeadId, 4>> cgal_alpha_complex(std::span<const ExactPoint> points);

}  // namespace kds::test
