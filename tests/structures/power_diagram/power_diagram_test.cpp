#include "structures/power_diagram/power_diagram.h"
#include "structures/collision/closest_pair.h"

#include <gmock/gmock.h>

#include <array>
#include <set>
#include <span>

#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/cgal_triangulation.h"
#include "tests/support/judges/exact_checks.h"
#include "tests/support/rounds.h"

namespace kds {
namespace {

using namespace test;

using PowerRig = Rig<PowerDiagram<3>, Space>;

/// The final cells at u = 1, checked by the definition and against CGAL over the rationals.
void expect_right_at_the_end(PowerRig& rig) {
  const StaticTriangulation<3> end = rig.structure.at_frame(false);
  const auto points = exact_points(rig.motion, Dyadic(1.0));
  const CgalCells cgal = cgal_regular_cells(points);
  ASSERT_TRUE(cgal.valid);
  EXPECT_EQ(points.size() - end.hidden.size(), cgal.visible);
  EXPECT_EQ(end.cells.empty(), cgal.cells.empty());
  EXPECT_EQ(not_regular(points, end.cells), std::nullopt);
}

/// Looks at every `stride`-th audit between events of the first step with its own eyes. (Later steps may
/// start from a flat frame, which `at_frame` answers for.) It looks a moment later: cells may be flat at a
/// single moment without an event.
Witness::Look definition(PowerRig& rig, int stride) {
  return [&rig, stride, count = 0](const Dyadic& time) mutable -> std::optional<std::string> {
    if (rig.simulator.step() != 0 || time == Dyadic(0.0) || time == Dyadic(1.0) || count++ % stride != 0)
      return std::nullopt;
    const Dyadic later((time.numerator() << 100U) + 1, time.exponent() + 100);
    return not_regular(exact_points(rig.motion, later), rig.structure.at_frame(false).cells);
  };
}

/// Runs with audits between all events. Clean refusals (InputError) are allowed and returned as true.
bool run_audited(const std::vector<Space>& steps, bool look = true, Kernel kernel = Kernel::filtered) {
  PowerRig rig(steps.front(), AuditMode::events, kernel);
  Witness witness(
      rig.simulator, look ? definition(rig, 1) : [](const Dyadic&) { return std::nullopt; });
  try {
    rig.run(steps);
  } catch (const InputError&) {
    return true;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return false;
  }
  expect_right_at_the_end(rig);
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  return false;
}

std::string to_text(const std::vector<Points>& frames) { return testing::PrintToString(frames); }

// General position: the instances of data/kinetic and the counts of CGAL's kinetic package.

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

TEST(PowerDiagram, AuditsPassBetweenAllEvents) {
  const std::array instances{std::pair("d3_n20_linear", 5), std::pair("d3_n50_linear", 200)};
  for (const auto& [name, stride] : std::span(instances).first(test::rounds(instances.size()))) {
    PowerRig rig(instance_motion<Space>(name), AuditMode::events);
    Witness witness(rig.simulator, definition(rig, stride));
    ASSERT_NO_THROW(rig.run()) << name;
    EXPECT_EQ(rig.structure.statistics.audits_run,
              rig.external_events() + 3);  // and before the first, and the ends
  }
}

// The diagram that is kept up knows the closest pair at every frame.
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

TEST(PowerDiagram, KernelsAgree) {
  const Space motion = instance_motion<Space>("d3_n20_linear");
  PowerRig filtered(motion);
  filtered.run();
  PowerRig exact(motion, AuditMode::none, Kernel::exact);
  exact.run();
  PowerRig fast(motion, AuditMode::none, Kernel::fast);
  fast.run();
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(fast.simulator.fingerprint(), filtered.simulator.fingerprint());
  const auto& counts = filtered.structure.statistics.certificates;
  EXPECT_EQ(exact.structure.statistics.certificates.created, counts.created);
  EXPECT_EQ(exact.structure.statistics.certificates.never_failing, counts.never_failing);
  EXPECT_EQ(exact.structure.statistics.certificates.peak, counts.peak);
}

TEST(PowerDiagram, KernelsAgreeOnRealTrajectories) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 4, 2);
  PowerRig filtered(steps.front(), AuditMode::frames);
  filtered.run(steps);
  PowerRig fast(steps.front(), AuditMode::none, Kernel::fast);
  fast.run(steps);
  EXPECT_GT(filtered.external_events(), 0U);
  EXPECT_EQ(filtered.structure.statistics.rebuilds, 0U);
  EXPECT_EQ(fast.simulator.fingerprint(), filtered.simulator.fingerprint());
  expect_right_at_the_end(filtered);
}

// Flips as logged: made on a set of cells by hand they lead from CGAL's cells at u = 0 to those at u = 1.
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
  for (const LoggedEvent& e : rig.history.events) {
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

// Certificates are born at their own root all the time; the double stages must settle them.
TEST(PowerDiagram, TheExactStageIsRareInGeneralPosition) {
  PowerRig rig(instance_motion<Space>("d3_n50_linear"));
  rig.run();
  const StageCounts& stages = rig.structure.statistics.stages;
  EXPECT_LT(stages.exact, rig.structure.statistics.certificates.created / 100);
  EXPECT_LT(stages.signs_exact, 100U);
}

TEST(PowerDiagram, CountsCertificatesPerBead) {
  const Points start{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  PowerRig rig(moving(start, start));
  rig.run();
  // Four facets of the one cell, each with infinity for a fifth, and six between infinite cells.
  EXPECT_EQ(rig.structure.statistics.certificates.created, 10U);
  EXPECT_EQ(rig.structure.statistics.certificates.peak, 10U);
  EXPECT_EQ(rig.structure.statistics.certificates.per_bead_max, 10U);
}

// The audit must be able to fail: every flip that can be made of a right diagram makes it wrong.
TEST(PowerDiagram, AuditsNoticeEveryWrongFlip) {
  const Space motion = instance_motion<Space>("d3_n20_linear");
  PowerRig rig(motion, AuditMode::frames);
  rig.run();
  EXPECT_EQ(rig.structure.audit(Dyadic(1.0)), std::nullopt);
  int tried = 0;
  for (const LoggedEvent& e : rig.history.events) {
    const bool to_edge = rig.structure.kinds()[e.change.kind].name == "2-3";
    for (const bool forth : {to_edge, !to_edge}) {
      Change change = e.change;
      change.kind = forth ? PowerDiagram<3>::to_edge : PowerDiagram<3>::to_facet;
      Change back = e.change;
      back.kind = forth ? PowerDiagram<3>::to_facet : PowerDiagram<3>::to_edge;
      // Only what leaves a triangulation: no second edge between two beads, no second facet of three.
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
               std::invalid_argument);  // another apex
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 3, 4, 1, 2}}),
               std::invalid_argument);  // no such cell
  EXPECT_THROW(rig.structure.apply({Diagram::to_facet, 5, {0, 1, 2, 3, 4}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 1, 9, 3, 4}}), std::invalid_argument);
  rig.structure.apply({Diagram::to_edge, 5, {0, 1, 2, 3, 4}});
  EXPECT_THROW(rig.structure.apply({Diagram::to_edge, 5, {0, 1, 2, 3, 4}}), std::invalid_argument);
  rig.structure.apply({Diagram::to_facet, 5, {0, 1, 2, 3, 4}});
}

// A log may have been edited: the diagram must stay a triangulation.
TEST(PowerDiagram, RefusesASecondEdgeBetweenTwoBeads) {
  const Points points{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 1}, {0, 0, -1}};  // three cells around 3-4
  PowerRig rig(moving(points, points));
  rig.run();
  EXPECT_THROW(rig.structure.apply({PowerDiagram<3>::to_edge, 5, {0, 3, 4, 1, 2}}), std::invalid_argument);
}

// Scenes by hand.

TEST(PowerDiagram, NeedsFourBeads) {
  PowerRig rig(moving({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}));
  EXPECT_THROW(rig.run(), InputError);
}

TEST(PowerDiagram, FourBeads) {
  const Points start{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  PowerRig still(moving(start, start), AuditMode::events);
  ASSERT_NO_THROW(still.run());
  EXPECT_EQ(still.history.events.size(), 0U);
  EXPECT_THAT(still.structure.at_frame(false).cells, testing::ElementsAre(CellBeads<3>{0, 1, 2, 3}));
  // The tetrahedron turns inside out: through a triangle with a bead inside; through a square; through both
  // at once.
  EXPECT_FALSE(run_audited({moving(start, {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}));
  EXPECT_FALSE(run_audited({moving({{1, 0, 1}, {-1, 0, 1}, {0, 1, -1}, {0, -1, -1}},
                                   {{1, 0, -1}, {-1, 0, -1}, {0, 1, 2}, {0, -1, 2}})}));
  EXPECT_FALSE(run_audited({moving(start, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}})}));
  for (const Space& motion : {moving(start, {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}) {
    EXPECT_FALSE(run_audited({motion}, true, Kernel::exact));
  }
}

TEST(PowerDiagram, FiveBeads) {
  // One bead goes through a triangle: 2-3, and out again on the other side: hull events.
  const Points base{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}};
  Points from = base, to = base;
  from.push_back({0, 0, -1});
  to.push_back({0, 0, 1});
  EXPECT_FALSE(run_audited({moving(from, to)}));
  from.back() = {1, 0, -7};
  to.back() = {1, 2, 17};
  EXPECT_FALSE(run_audited({moving(from, to)}));
  // Cospherical for ever: an octahedron that loses a bead, turned by a quarter in its plane.
  EXPECT_FALSE(run_audited({moving({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                   {{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}})}));
}

TEST(PowerDiagram, CoplanarAtTheStart) {
  const Points flat{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {6, 7, 0}, {2, 3, 0}, {-3, 2, 0}};
  Points lifted = flat;
  for (std::size_t b = 0; b < lifted.size(); ++b) lifted[b][2] = static_cast<double>(b * b % 5);
  PowerRig rig(moving(flat, lifted), AuditMode::events);
  Witness witness(rig.simulator, definition(rig, 1));
  ASSERT_NO_THROW(rig.simulator.build());
  EXPECT_TRUE(rig.structure.at_frame(true).cells.empty()) << "cells of a frame that is flat";
  ASSERT_NO_THROW(rig.simulator.run_step());
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  expect_right_at_the_end(rig);
}

TEST(PowerDiagram, CoplanarAtTheStartThenFarFromIt) {
  std::mt19937 random(3);
  for (int round = 0; round < test::rounds(30); ++round) {
    Points flat = random_grid_points(random, 7, 20);
    for (auto& p : flat) p[2] = p[0];
    const Points to = random_grid_points(random, 7, 20);
    SCOPED_TRACE(to_text({flat, to}));
    run_audited({moving(flat, to)});
    if (HasFailure()) return;
  }
}

TEST(PowerDiagram, CoplanarAtTheEndOrInBetween) {
  const Points solid{{0, 0, 1}, {4, 0, 2}, {0, 5, 5}, {6, 7, 3}, {2, 3, 4}, {-3, 2, 7}};
  Points flat = solid, mirrored = solid;
  for (auto& p : flat) p[2] = 0;
  for (auto& p : mirrored) p[2] = -p[2];
  EXPECT_FALSE(run_audited({moving(solid, flat)}));
  EXPECT_FALSE(run_audited({moving(solid, mirrored)}));
  EXPECT_FALSE(run_audited(through({solid, flat, mirrored})));
  EXPECT_FALSE(run_audited(through({solid, flat, solid})));
}

TEST(PowerDiagram, CoplanarAllTheTimeIsRefused) {
  const Points flat{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {6, 7, 0}, {2, 3, 0}};
  const Points other{{1, 0, 0}, {4, 2, 0}, {0, 5, 0}, {6, 8, 0}, {2, 1, 0}};
  PowerRig rig(moving(flat, other));
  EXPECT_THROW(rig.run(), InputError);
  // After a step in space it may be refused, or done rightly.
  Points solid = flat;
  solid[2][2] = 1;
  run_audited(through({solid, flat, other}));
  run_audited(through({solid, flat, other, solid}));
}

TEST(PowerDiagram, BeadsThatMeet) {
  const Points base{{0, 0, 0}, {5, 0, 1}, {0, 6, 0}, {1, 0, 7}, {6, 5, 4}};
  const auto with = [&](std::initializer_list<std::array<double, 3>> more) {
    Points points = base;
    points.insert(points.end(), more);
    return points;
  };
  // In between, at the end, at a frame and back, at a frame and through, from the start.
  EXPECT_FALSE(run_audited({moving(with({{1, 1, 1}, {3, 3, 3}}), with({{3, 3, 3}, {1, 1, 1}}))}));
  EXPECT_FALSE(run_audited({moving(with({{1, 1, 1}, {3, 3, 3}}), with({{2, 2, 2}, {2, 2, 2}}))}));
  EXPECT_FALSE(run_audited(
      through({with({{1, 1, 1}, {3, 3, 3}}), with({{2, 2, 2}, {2, 2, 2}}), with({{1, 1, 1}, {3, 3, 3}})})));
  EXPECT_FALSE(run_audited(
      through({with({{1, 1, 1}, {3, 3, 3}}), with({{2, 2, 2}, {2, 2, 2}}), with({{3, 3, 3}, {1, 1, 1}})})));
  const std::vector<Space> parting{moving(with({{2, 2, 2}, {2, 2, 2}}), with({{3, 3, 3}, {1, 1, 1}}))};
  EXPECT_FALSE(run_audited(parting));
  PowerRig rig(parting.front());
  rig.simulator.build();
  EXPECT_EQ(rig.structure.at_frame(true).hidden.size(), 1U) << "one of two beads in one place at the start";
}

TEST(PowerDiagram, OfBeadsInOnePlaceForGoodOneIsHidden) {
  const Points points{{0, 0, 0}, {5, 0, 1}, {0, 6, 0}, {1, 0, 7}, {6, 5, 4}, {6, 5, 4}};
  PowerRig rig(moving(points, points), AuditMode::events);
  ASSERT_NO_THROW(rig.run());
  EXPECT_EQ(rig.structure.at_frame(false).hidden.size(), 1U);
}

// Two beads pass each other along an edge of the hull, on a line with its ends for ever: certificates that
// are zero all the time see no fold.
TEST(PowerDiagram, BeadsThatTradePlacesAlongAnEdgeOfTheHull) {
  EXPECT_FALSE(run_audited({moving({{1, 0, 1}, {1, 1, 0}, {1, 1, 1}, {1, 1, 0}, {1, 0, 1}, {0, 0, 0}},
                                   {{1, 0, 1}, {1, 1, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}})}));
}

// A cell that is flat at a frame and stays so for the step after it, as repeated frames have it.
TEST(PowerDiagram, FlatCellsDoNotOutliveTheirFrame) {
  const Points solid{{0, 0, 0}, {6, 0, 1}, {0, 6, 2}, {6, 6, 5}, {3, 3, 9}, {2, 3, -7}};
  Points square = solid;
  for (std::size_t b = 0; b < 4; ++b) square[b][2] = 0;
  for (const double height : {9.0, 2.0, 0.5}) {
    square[4][2] = height;
    run_audited(through({solid, square, square, solid}));
    run_audited(through({solid, square, square, square}));
  }
}

// As repeated frames have it, or a chain that slides in its plane: nothing is there between.
TEST(PowerDiagram, StepsInOnePlaneHaveNoCells) {
  const Points solid{{0, 0, 0}, {6, 0, 1}, {0, 6, 2}, {6, 6, 5}, {3, 3, 9}, {2, 3, -7}, {2, 3, -7}};
  const auto laid = [](Points points) {
    for (auto& p : points) p[2] = p[0] + 2 * p[1];
    return points;
  };
  const Points flat = laid(solid),
               slid = laid({{1, 0, 0}, {3, 4, 0}, {2, 2, 0}, {1, 1, 0}, {9, 1, 0}, {4, 4, 0}, {4, 4, 0}});
  const Points line{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}, {6, 6, 6}, {4, 4, 4}};
  for (const std::vector<Points>& frames : {std::vector<Points>{flat, flat, solid},
                                            {flat, slid, flat, solid, slid},
                                            {solid, flat, slid, slid, solid},
                                            {solid, flat, slid},
                                            {line, line, slid, flat, solid, line, line}}) {
    SCOPED_TRACE(to_text(frames));
    const std::vector<Space> steps = through(frames);
    EXPECT_FALSE(run_audited(steps, false));
    PowerRig filtered(steps.front()), again(steps.front());
    PowerRig exact(steps.front(), AuditMode::none, Kernel::exact);
    PowerRig fast(steps.front(), AuditMode::none, Kernel::fast);
    filtered.run(steps);
    exact.run(steps);
    fast.run(steps);
    EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
    again.replay(steps, filtered.history);
    EXPECT_EQ(filtered.simulator.fingerprint(), again.simulator.fingerprint());
    EXPECT_EQ(filtered.structure.at_frame(false).cells, again.structure.at_frame(false).cells);
  }
  EXPECT_TRUE(run_audited(through({flat, slid, flat}), false)) << "never any";
}

// Flat at the start, and at the very next time that a rebuild is tried at too.
TEST(PowerDiagram, FlatAtTwoTimesIsNotFlatForGood) {
  const double soon = 0x1p-200;
  const Points from{{soon, 0, 0}, {0, 0, 0}, {5, 0, 0}, {0, 0, 0}},
      to{{soon, 0, 0}, {1, 0, 0}, {5, 1, 0}, {0, 0, 1}};
  PowerRig rig(moving(from, to), AuditMode::events);
  EXPECT_THROW(rig.run(), InputError) << "closer than it can be rebuilt between";
}

// Degenerate input.

class DegeneratePower : public testing::TestWithParam<const char*> {
 protected:
  Space motion = instance_motion<Space>(std::string("degenerate_d3_n64_") + GetParam());
};

TEST_P(DegeneratePower, AuditsPassBetweenAllEvents) {
  PowerRig rig(motion, AuditMode::events);
  Witness witness(rig.simulator, definition(rig, 40));
  ASSERT_NO_THROW(rig.run());
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  expect_right_at_the_end(rig);
  const std::string name = GetParam();
  if (name == "static" || name == "rigid" || name == "gridrigid" || name == "gridscale" ||
      name == "converge") {
    EXPECT_EQ(rig.external_events(), 0U);
  }
  if (name == "half") {
    EXPECT_EQ(rig.external_events(), 1263U);
  }
  if (name == "converge") {
    EXPECT_EQ(rig.structure.at_frame(false).hidden.size(), 63U);
    EXPECT_TRUE(rig.structure.at_frame(false).cells.empty());
  }
}

TEST_P(DegeneratePower, FastEndsAndIsRightAtTheFrameItEndsIn) {
  PowerRig rig(motion, AuditMode::none, Kernel::fast);
  ASSERT_NO_THROW(rig.run());
}

INSTANTIATE_TEST_SUITE_P(Data, DegeneratePower,
                         testing::Values("static", "half", "rigid", "gridrigid", "gridscale", "converge",
                                         "gridrand", "gridint", "swap"),
                         [](const auto& test) { return test.param; });

TEST(PowerDiagram, RandomMotionsFullOfTies) {
  std::mt19937 random(2);
  int refused = 0, ran = 0;
  for (int round = 0; round < test::rounds(400); ++round) {
    const std::size_t beads = 4 + random() % 7;
    const int range = 2 + static_cast<int>(random() % 4);
    const Points from = random_grid_points(random, beads, range);
    const Points to = random_grid_points(random, beads, range);
    SCOPED_TRACE(text_of("round ", round, ": ", to_text({from, to})));
    ++(run_audited({moving(from, to)}) ? refused : ran);
    if (HasFailure()) return;
  }
  EXPECT_GT(ran, test::rounds(350));
}

TEST(PowerDiagram, RandomFramesFullOfTies) {
  std::mt19937 random(12);
  for (int round = 0; round < test::rounds(60); ++round) {
    const std::size_t beads = 5 + random() % 6;
    std::vector<Points> frames;
    for (int k = 0; k < 4; ++k)
      frames.push_back(k > 0 && random() % 4 == 0 ? frames.back() : random_grid_points(random, beads, 3));
    SCOPED_TRACE(text_of("round ", round, ": ", to_text(frames)));
    run_audited(through(frames));
    if (HasFailure()) return;
  }
}

TEST(PowerDiagram, ExactAgreesOnMotionsFullOfTies) {
  std::mt19937 random(13);
  for (int round = 0; round < test::rounds(25); ++round) {
    const Points from = random_grid_points(random, 7, 4);
    const Points to = random_grid_points(random, 7, 4);
    SCOPED_TRACE(text_of("round ", round, ": ", to_text({from, to})));
    PowerRig filtered(moving(from, to));
    PowerRig exact(moving(from, to), AuditMode::none, Kernel::exact);
    try {
      filtered.run();
      exact.run();
    } catch (const InputError&) {
      continue;
    }
    EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
    if (HasFailure()) return;
  }
}

// Beads that stay together hide each other by turns; which facet of an event comes first must not tell.
TEST(PowerDiagram, ExactAgreesOnTwinsThatStayTogether) {
  std::mt19937 random(13);
  for (int round = 0; round < test::rounds(500); ++round) {
    const std::size_t beads = 6 + 2 * (random() % 4);
    const int range = 3 + static_cast<int>(random() % 4);
    Points from = random_grid_points(random, beads, range), to = random_grid_points(random, beads, range);
    const bool weighted = random() % 2 != 0;
    for (std::size_t b = 0; b + 1 < beads; b += 2) {
      if (random() % 4 == 0) continue;
      from[b + 1] = from[b];
      to[b + 1] = to[b];
    }
    Space motion = moving(from, to);
    for (BeadId b = 0; b < beads; ++b)
      for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weighted ? b % 3 : 0);
    PowerRig filtered(motion);
    PowerRig exact(motion, AuditMode::none, Kernel::exact);
    try {
      filtered.run();
      exact.run();
    } catch (const InputError&) {
      continue;
    }
    ASSERT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint())
        << "round " << round << ": " << to_text({from, to});
  }
}

TEST(PowerDiagram, FastAlwaysEnds) {
  std::mt19937 random(14);
  for (int round = 0; round < test::rounds(200); ++round) {
    const Points from = random_grid_points(random, 8, 3);
    const Points to = random_grid_points(random, 8, 3);
    SCOPED_TRACE(text_of("round ", round, ": ", to_text({from, to})));
    PowerRig rig(moving(from, to), AuditMode::none, Kernel::fast);
    try {
      rig.run();
    } catch (const InputError&) {
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
      return;
    }
  }
}

// Beads that creep, and all drift away together.
std::vector<Space> creeping(std::mt19937& random, std::size_t beads, std::size_t frames, double step) {
  std::uniform_real_distribution<double> anywhere(0, 1), wander(-step, step);
  std::vector<Points> path(frames, Points(beads));
  for (std::size_t k = 0; k < frames; ++k) {
    for (std::size_t b = 0; b < beads; ++b) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        path[k][b][axis] = k == 0 ? anywhere(random) : path[k - 1][b][axis] + 0.75 + wander(random);
    }
  }
  return through(path);
}

TEST(PowerDiagram, InSlowMotionMostFacetsRest) {
  std::mt19937 random(8);
  for (const double step : {1e-9, 1e-4, 5e-4}) {
    const auto steps = creeping(random, 40, 16, step);
    PowerRig filtered(steps.front(), step > 1e-9 ? AuditMode::events : AuditMode::frames);
    filtered.run(steps);
    PowerRig exact(steps.front(), AuditMode::none, Kernel::exact);
    exact.run(steps);
    EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
    const auto& counts = filtered.structure.statistics.certificates;
    EXPECT_EQ(counts.created, exact.structure.statistics.certificates.created);
    EXPECT_EQ(counts.never_failing, exact.structure.statistics.certificates.never_failing);
    EXPECT_TRUE(test::books_balance(filtered.structure.statistics));
    EXPECT_GT(filtered.structure.statistics.stages.slack, counts.created / 4) << step;
    EXPECT_EQ(exact.structure.statistics.stages.slack, 0U);
    if (step > 1e-9) {
      EXPECT_GT(filtered.external_events(), 0U) << step;
    }
  }
}

TEST(PowerDiagram, ATranslationGivesNoEvent) {
  const Space first = trajectory_steps("villin_hp36_300K.dcd", 0, 1).front();
  std::vector<Points> frames(11, Points(first.bead_count()));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (BeadId b = 0; b < first.bead_count(); ++b) {
      // Whole multiples of 2^-12: a sum is not rounded.
      for (int axis = 0; axis < 3; ++axis) {
        frames[k][b][static_cast<std::size_t>(axis)] =
            std::round(first.coordinate(b, 0, axis) * 4096) / 4096 + static_cast<double>(k) * (0.5 + axis);
      }
    }
  }
  PowerRig rig(moving(frames[0], frames[1]), AuditMode::frames);
  rig.run(through(frames));
  EXPECT_EQ(rig.history.events.size(), 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.failed, 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.never_failing,
            rig.structure.statistics.certificates.created);
}

}  // namespace
}  // namespace kds
