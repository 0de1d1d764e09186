// Flips that a failed certificate requests, and flips as a log stores them.

#include "structures/power_diagram/diagram_flips.h"

#include <gtest/gtest.h>

#include "tests/structures/power_diagram/bare_diagram.h"

namespace kds::diagram_flips_test {
namespace {

using namespace test;
using Events = DiagramEvents<3>;

TEST(DiagramFlips, RepairWhatFails) {
  for (const double heaviest : {0.0, 0.1}) {
    BareRig<3> rig(random_beads<3>(1, 40, 0.05, heaviest), AuditMode::events);
    BareDiagram<3>& diagram = rig.structure;
    rig.simulator.build();
    rig.simulator.enter_step();
    diagram.rebuilder.watch_all();
    ASSERT_NO_THROW(rig.simulator.leave_step());
    EXPECT_GT(rig.external_events(), 30U);
    EXPECT_EQ(diagram.statistics.rebuilds, 0U);
    EXPECT_EQ(diagram.state.present, Identity{});
    EXPECT_EQ(diagram.statistics.events_by_kind[Events::hides] > 0, heaviest > 0);
  }
}

// A bead passes through a triangle, which is a 2-3 flip. The reverse flip undoes it, and so for every logged
// flip.
TEST(DiagramFlips, AreUndone) {
  const Points points{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}, {0, 0, -5}};
  BareRig<3> rig(moving(points, points));
  rig.simulator.build();
  rig.structure.start_step();
  const auto cells = rig.structure.state.triangulation.finite_cells();
  rig.structure.flips.apply({Events::to_edge, 5, {0, 1, 2, 3, 4}});
  EXPECT_EQ(rig.structure.state.triangulation.finite_cells().size(), 3U);
  EXPECT_THROW(rig.structure.flips.apply({Events::to_edge, 5, {0, 1, 2, 3, 4}}), std::invalid_argument);
  rig.structure.flips.apply({Events::to_facet, 5, {0, 1, 2, 3, 4}});
  EXPECT_EQ(rig.structure.state.triangulation.finite_cells(), cells);
}

}  // namespace
}  // namespace kds::diagram_flips_test
