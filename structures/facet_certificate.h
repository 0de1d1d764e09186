#pragma once
// What guards a facet of a regular triangulation: the power test of its two cells' five beads, or, where the
// infinite vertex is among them, the orientation of the other four (the hull is locally convex there).

#include <algorithm>
#include <array>

#include "certificates/orientation.h"
#include "certificates/power_test.h"
#include "structures/regular_triangulation.h"

namespace kds {

/// Calls `use` with the certificate of the facet between a cell and the one with this apex beyond it.
template <class Use>
decltype(auto) with_facet_certificate(const CellBeads& cell, BeadId apex, Use use) {
  const std::array<BeadId, 5> five{cell[0], cell[1], cell[2], cell[3], apex};
  const auto infinite = std::find(five.begin(), five.end(), infinite_bead);
  if (infinite == five.end()) return use(PowerTest(five, 1));
  // A row (0,0,0,1) at the place of infinity: expand the power test's determinant along it.
  std::array<BeadId, 4> four{};
  std::copy(infinite + 1, five.end(), std::copy(five.begin(), infinite, four.begin()));
  return use(Orientation(four, (infinite - five.begin()) % 2 == 0 ? 1 : -1));
}

}  // namespace kds
