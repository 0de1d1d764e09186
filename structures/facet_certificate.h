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
  const PowerTest test({cell[0], cell[1], cell[2], cell[3], apex}, 1);
  if (test.beads[4] != infinite_bead) return use(test);
  // Sorted, infinity is last: a row (0,0,0,1) there leaves the determinant of the others.
  Orientation orientation;
  std::copy(test.beads.begin(), test.beads.end() - 1, orientation.beads.begin());
  orientation.sign = test.sign;
  return use(orientation);
}

}  // namespace kds
