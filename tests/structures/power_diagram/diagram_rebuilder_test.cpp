// Rebuilds just after the present time, and the static diagrams that they use.

#include "structures/power_diagram/diagram_rebuilder.h"

#include <gtest/gtest.h>

#include "motions/base/input_error.h"
#include "structures/power_diagram/diagram_state.h"
#include "tests/structures/power_diagram/bare_diagram.h"

namespace kds::diagram_rebuilder_test {
namespace {

using namespace test;

TEST(DiagramRebuilder, BuildsWhereItStandsBeforeAnythingFails) {
  BareRig<3> rig(random_beads<3>(1, 40, 0.05, 0.1), AuditMode::events);
  BareDiagram<3>& diagram = rig.structure;
  rig.simulator.build();
  rig.simulator.enter_step();
  diagram.rebuilder.watch_all();
  rig.simulator.run_until(Dyadic(0.5));
  const auto cells = diagram.state.triangulation.finite_cells();
  diagram.rebuilder.rebuild_at_first_time_that_works();
  EXPECT_EQ(diagram.statistics.rebuilds, 1U);
  EXPECT_EQ(diagram.state.triangulation.finite_cells(), cells);
  EXPECT_EQ(diagram.statistics.certificates.alive, diagram.expected_alive());
  // The log contains the time of the rebuild, so a replay can repeat it.
  const Change change = rig.history.events.back().change;
  ASSERT_EQ(change.kind, DiagramEvents<3>::rebuild);
  diagram.rebuilder.apply(change);
  EXPECT_EQ(diagram.state.triangulation.finite_cells(), cells);
  EXPECT_THROW(diagram.rebuilder.apply({DiagramEvents<3>::rebuild, 1, {201}}), std::invalid_argument);
  EXPECT_THROW(diagram.rebuilder.apply({DiagramEvents<3>::rebuild, 2, {1, 2}}), std::invalid_argument);
}

TEST(DiagramRebuilder, FindsNoCellsInOnePlane) {
  Points points{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {6, 7, 0}, {2, 3, 0}};
  BareRig<3> rig(moving(points, points));
  rig.simulator.build();
  EXPECT_FALSE(rig.structure.state.has_cells());
  rig.simulator.enter_step();
  EXPECT_FALSE(rig.structure.rebuilder.try_to_rebuild());
  EXPECT_THROW(rig.structure.rebuilder.rebuild_at_first_time_that_works(), InputError);
}

// The exact positions at both ends are the doubles. Beads that are left out do not shift the numbers of other
// beads.
TEST(StaticDiagrams, AreOfTheBeadsPresent) {
  BareRig<3> rig(random_beads<3>(2, 40, 0.05, 0.1));
  BareDiagram<3>& diagram = rig.structure;
  for (const BeadId bead : {0U, 10U, 39U}) diagram.state.present_beads.leave_out(bead);
  rig.simulator.build();
  const std::vector<BeadId> present = diagram.state.present_beads.all();
  EXPECT_EQ(present.size(), 37U);
  for (const int k : {0, 1}) {
    const auto at_end = static_diagram_at_end(diagram.state, k);
    const auto exact =
        static_diagram(diagram.state, std::span<const BeadId>(present), Dyadic(double(k)), false);
    EXPECT_EQ(at_end.cells, exact.cells);
    EXPECT_EQ(at_end.hidden, exact.hidden);
    for (const auto& cell : at_end.cells) {
      for (const BeadId bead : {0U, 10U, 39U}) EXPECT_EQ(std::count(cell.begin(), cell.end(), bead), 0);
    }
  }
  EXPECT_EQ(static_diagram_at_end(diagram.state, 0).cells, diagram.state.triangulation.finite_cells());
}

}  // namespace
}  // namespace kds::diagram_rebuilder_test
