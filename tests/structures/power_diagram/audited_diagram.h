#pragma once
// A power diagram in space that is run with audits and inspected with exact numbers.

#include <gmock/gmock.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "motions/base/input_error.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/cgal_triangulation.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::test {

using PowerRig = Rig<PowerDiagram<3>, Space>;

/// Checks the final cells at u = 1 by the definition and against CGAL over rationals.
inline void expect_right_at_the_end(PowerRig& rig) {
  const StaticTriangulation<3> end = rig.structure.at_frame(false);
  const auto points = exact_points(rig.motion, Dyadic(1.0));
  const CgalCells cgal = cgal_regular_cells(points);
  ASSERT_TRUE(cgal.valid);
  EXPECT_EQ(points.size() - end.hidden.size(), cgal.visible);
  EXPECT_EQ(end.cells.empty(), cgal.cells.empty());
  EXPECT_EQ(not_regular(points, end.cells), std::nullopt);
}

}  // namespace kds::test
