// Handmade scenes: few beads, in one plane or at one place.
#include "tests/structures/power_diagram/audited_diagram.h"

#include "motions/base/input_error.h"
#include "tests/support/rounds.h"

namespace kds::flat_frames_test {
namespace {

using namespace test;

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
  // A tetrahedron turns inside out: through a triangle with a bead inside; through a square; through both at
  // once.
  EXPECT_FALSE(run_audited({moving(start, {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}));
  EXPECT_FALSE(run_audited({moving({{1, 0, 1}, {-1, 0, 1}, {0, 1, -1}, {0, -1, -1}},
                                   {{1, 0, -1}, {-1, 0, -1}, {0, 1, 2}, {0, -1, 2}})}));
  EXPECT_FALSE(run_audited({moving(start, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}})}));
  for (const Space& motion : {moving(start, {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})}) {
    EXPECT_FALSE(run_audited({motion}, true, Kernel::exact));
  }
}

TEST(PowerDiagram, FiveBeads) {
  // One bead moves through a triangle (a 2-3 flip) and leaves on the other side (hull events).
  const Points base{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}};
  Points from = base, to = base;
  from.push_back({0, 0, -1});
  to.push_back({0, 0, 1});
  EXPECT_FALSE(run_audited({moving(from, to)}));
  from.back() = {1, 0, -7};
  to.back() = {1, 2, 17};
  EXPECT_FALSE(run_audited({moving(from, to)}));
  // Beads that stay cospherical: an octahedron that loses a bead, and a quarter turn in its plane.
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
  // After a step in space, the flat step may be refused or handled correctly.
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
  // The beads meet inside the step, at its end, at a frame where they turn back, at a frame that they pass
  // through, and at the start.
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

// Two beads pass each other along an edge of the hull and stay on a line with the ends of the edge. The
// certificates that are zero throughout cannot detect a fold.
TEST(PowerDiagram, BeadsThatTradePlacesAlongAnEdgeOfTheHull) {
  EXPECT_FALSE(run_audited({moving({{1, 0, 1}, {1, 1, 0}, {1, 1, 1}, {1, 1, 0}, {1, 0, 1}, {0, 0, 0}},
                                   {{1, 0, 1}, {1, 1, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}})}));
}

// A cell that is flat at a frame and during the whole next step, as with repeated frames.
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

// Flat steps, as with repeated frames or a chain that slides in its plane: the diagram has no cells during
// such a step.
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
    filtered.run(steps);
    exact.run(steps);
    EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
    again.replay(steps, filtered.history);
    EXPECT_EQ(filtered.simulator.fingerprint(), again.simulator.fingerprint());
    EXPECT_EQ(filtered.structure.at_frame(false).cells, again.structure.at_frame(false).cells);
  }
  EXPECT_TRUE(run_audited(through({flat, slid, flat}), false)) << "never any";
}

// The beads are coplanar at the start, and again so soon that the finest grid of times in a log does not
// separate the two moments.
TEST(PowerDiagram, RebuildsBetweenTimesOfAnyDistance) {
  for (const double soon : {0x1p-199, 0x1p-200, 0x1p-300, 0x1p-1000}) {
    SCOPED_TRACE(soon);
    const Points from{{soon, 0, 0}, {0, 0, 0}, {5, 0, 0}, {0, 0, 0}},
        to{{soon, 0, 0}, {1, 0, 0}, {5, 1, 0}, {0, 0, 1}};
    PowerRig rig(moving(from, to), AuditMode::events),
        exact(moving(from, to), AuditMode::none, Kernel::exact), again(moving(from, to));
    rig.run();
    exact.run();
    EXPECT_GT(rig.structure.statistics.rebuilds, 0U);
    EXPECT_EQ(rig.simulator.fingerprint(), exact.simulator.fingerprint());
    again.replay({rig.motion}, rig.history);
    EXPECT_EQ(rig.simulator.fingerprint(), again.simulator.fingerprint());
    EXPECT_EQ(rig.structure.at_frame(false).cells, again.structure.at_frame(false).cells);
  }
}

}  // namespace
}  // namespace kds::flat_frames_test
