#include "structures/power_diagram/power_diagram.h"

#include <gmock/gmock.h>

#include <array>
#include <set>
#include <span>

#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"
#include "structures/collision/closest_pair.h"
#include "tests/structures/power_diagram/audited_diagram.h"
#include "tests/support/rounds.h"

namespace kds::power_diagram_test {
namespace {

using namespace test;

// General position: the instances of data/kinetic and the event counts of CGAL's kinetic package.

struct Count {
  std::string name;
  std::uint64_t events;
};
void PrintTo(const Count& count, std::ostream* out) { *out << count.name; }

class PowerInstance : public testing::TestWithParam<Count> {};

TEST_P(PowerInstance, HasTheEventsOfCgal) {
  const Space motion = instance_motion<Space>(GetParam().name);
  PowerRig rig(motion, AuditMode::frames);
  rig.run();
  EXPECT_EQ(rig.external_events(), GetParam().events);
  EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
  EXPECT_EQ(rig.history.events.size(), GetParam().events);
  const auto& kinds = rig.structure.statistics.events_by_kind;
  EXPECT_EQ(kinds[0] + kinds[1], GetParam().events);
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  expect_right_at_the_end(rig);

  PowerRig replayed(motion, AuditMode::frames);
  ASSERT_NO_THROW(replayed.replay({motion}, rig.history));
  EXPECT_EQ(replayed.simulator.fingerprint(), rig.simulator.fingerprint());
  EXPECT_EQ(replayed.structure.at_frame(false).cells, rig.structure.at_frame(false).cells);
}

INSTANTIATE_TEST_SUITE_P(Data, PowerInstance,
                         testing::Values(Count{"d3_n20_linear", 234}, Count{"d3_n50_linear", 1453},
                                         Count{"d3_n100_linear", 4225}, Count{"d3_n200_linear", 11286}),
                         [](const auto& test) { return test.param.name; });

// The maintained diagram gives the closest pair at every frame.
TEST(PowerDiagram, EdgesAtFramesHaveTheClosestPair) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 4);
  PowerRig rig(steps[0]);
  const std::vector<double> radii(rig.motion.bead_count(), 0.5);
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(radii.size() - 1)}};
  const BeadPairs neighbors = BeadPairs::along(radii.size(), necklace);
  rig.simulator.build();
  for (const Space& step : steps) {
    rig.step(step);
    const Eigen::Matrix3Xd centers = control_points(step, 1);
    const auto kept = closest_pair<3>(centers, radii, rig.structure.edges_at_frame(false), neighbors);
    const auto built = closest_pair<3>(centers, radii, neighbors);
    ASSERT_TRUE(kept.pair && built.pair);
    EXPECT_EQ(kept.pair->first, built.pair->first);
    EXPECT_EQ(kept.pair->second, built.pair->second);
    EXPECT_EQ(kept.looked_at.edges, built.looked_at.edges);
  }
}

// Applying the logged flips to a set of cells leads from CGAL's cells at u = 0 to CGAL's cells at u = 1.
TEST(PowerDiagram, LoggedFlipsTurnTheFirstCellsIntoTheLast) {
  const Space motion = instance_motion<Space>("d3_n20_linear");
  PowerRig rig(motion);
  rig.run();
  using Cells = std::set<CellBeads<3>>;
  const auto start = cgal_regular_cells(exact_points(motion, Dyadic(0.0))).cells;
  Cells cells(start.begin(), start.end());
  const auto cell = [](std::initializer_list<BeadId> beads) {
    CellBeads<3> sorted{};
    std::copy(beads.begin(), beads.end(), sorted.begin());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  const auto finite = [](const CellBeads<3>& c) { return c[3] != infinite_bead; };
  for (const Event& e : rig.history.events) {
    const auto& id = e.change.ids;
    ASSERT_EQ(e.change.size, 5);
    EXPECT_TRUE(id[0] < id[1] && id[1] < id[2] && id[3] < id[4]);
    const std::array<CellBeads<3>, 2> two{cell({id[0], id[1], id[2], id[3]}),
                                          cell({id[0], id[1], id[2], id[4]})};
    const std::array<CellBeads<3>, 3> three{cell({id[0], id[1], id[3], id[4]}),
                                            cell({id[0], id[2], id[3], id[4]}),
                                            cell({id[1], id[2], id[3], id[4]})};
    const bool to_edge = rig.structure.kinds()[e.change.kind].name == "2-3";
    ASSERT_TRUE(to_edge || rig.structure.kinds()[e.change.kind].name == "3-2");
    for (const CellBeads<3>& c : two) {
      if (finite(c)) {
        EXPECT_EQ(to_edge ? cells.erase(c) : cells.insert(c).second, 1U);
      }
    }
    for (const CellBeads<3>& c : three) {
      if (finite(c)) {
        EXPECT_EQ(to_edge ? cells.insert(c).second : cells.erase(c), 1U);
      }
    }
  }
  EXPECT_EQ(std::vector(cells.begin(), cells.end()),
            cgal_regular_cells(exact_points(motion, Dyadic(1.0))).cells);
}

TEST(PowerDiagram, CountsCertificatesPerBead) {
  const Points start{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  PowerRig rig(moving(start, start));
  rig.run();
  // The only cell has four facets, each with the infinite vertex as the fifth vertex; six more facets lie
  // between infinite cells.
  EXPECT_EQ(rig.structure.statistics.certificates.created, 10U);
  EXPECT_EQ(rig.structure.statistics.certificates.peak, 10U);
  EXPECT_EQ(rig.structure.statistics.certificates.per_bead_max, 10U);
}

// The audit must be able to fail: every possible flip of a correct diagram makes it wrong.
TEST(PowerDiagram, AuditsNoticeEveryWrongFlip) {
  const Space motion = instance_motion<Space>("d3_n20_linear");
  PowerRig rig(motion, AuditMode::frames);
  rig.run();
  EXPECT_EQ(rig.structure.audit(Dyadic(1.0)), std::nullopt);
  int tried = 0;
  for (const Event& e : rig.history.events) {
    const bool to_edge = rig.structure.kinds()[e.change.kind].name == "2-3";
    for (const bool forth : {to_edge, !to_edge}) {
      Change change = e.change;
      change.kind = forth ? PowerDiagram<3>::to_edge : PowerDiagram<3>::to_facet;
      Change back = e.change;
      back.kind = forth ? PowerDiagram<3>::to_facet : PowerDiagram<3>::to_edge;
      // Applies only flips that leave a triangulation: two beads have at most one edge, and three beads at
      // most one facet.
      const auto together = [cells = rig.structure.at_frame(false).cells](std::span<const BeadId> beads) {
        return std::any_of(cells.begin(), cells.end(), [&](const CellBeads<3>& cell) {
          return std::all_of(beads.begin(), beads.end(),
                             [&](BeadId b) { return std::find(cell.begin(), cell.end(), b) != cell.end(); });
        });
      };
      const std::span ids(e.change.ids);
      if (std::count(ids.begin(), ids.begin() + 5, infinite_bead) != 0) continue;
      if (forth ? together(ids.subspan(3, 2)) : together(ids.first(3))) continue;
      try {
        rig.structure.apply(change);
      } catch (const std::invalid_argument&) {
        continue;
      }
      ++tried;
      EXPECT_NE(rig.structure.audit(Dyadic(1.0)), std::nullopt);
      EXPECT_NE(rig.structure.audit(Dyadic(1023, 10)), std::nullopt);
      rig.structure.apply(back);
      EXPECT_EQ(rig.structure.audit(Dyadic(1.0)), std::nullopt);
    }
  }
  EXPECT_GT(tried, 10);
  EXPECT_NE(rig.structure.audit(Dyadic(0.0)), std::nullopt);
  EXPECT_NE(rig.structure.audit(Dyadic(0.5)), std::nullopt);
}

TEST(PowerDiagram, RefusesChangesThatCannotBe) {
  const Points points{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}, {0, 0, -5}};
  PowerRig rig(moving(points, points));
  rig.run();
  using Diagram = PowerDiagram<3>;
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 1, 3, 2, 4}}),
               std::invalid_argument);  // a different apex
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 3, 4, 1, 2}}),
               std::invalid_argument);  // this cell does not exist
  EXPECT_THROW(rig.structure.apply({Diagram::to_facet, 5, {0, 1, 2, 3, 4}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 1, 9, 3, 4}}), std::invalid_argument);
  rig.structure.apply({Diagram::to_edge, 5, {0, 1, 2, 3, 4}});
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 1, 2, 3, 4}}), std::invalid_argument);
  rig.structure.apply({Diagram::to_facet, 5, {0, 1, 2, 3, 4}});
}

// A log may have been edited; the diagram must still be a triangulation.
TEST(PowerDiagram, RefusesASecondEdgeBetweenTwoBeads) {
  // Three cells lie around edge 3-4.
  const Points points{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 1}, {0, 0, -1}};
  PowerRig rig(moving(points, points));
  rig.run();
  EXPECT_THROW(rig.structure.apply({PowerDiagram<3>::to_edge, 5, {0, 3, 4, 1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace kds::power_diagram_test
