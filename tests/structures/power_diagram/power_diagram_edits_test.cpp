// Beads are inserted, erased and change course while the power diagram runs. After each edit and between all
// events, audits compare the diagram with CGAL over rationals and with the definition.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "motions/base/input_error.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/courses.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::power_diagram_edits_test {
namespace {

using namespace test;
using testing::HasSubstr;

template <class M>
using Diagram = PowerDiagram<M::dimension>;

Space random_space(std::size_t beads, unsigned seed, double weight) {
  Random random(seed);
  Space motion(beads);
  const double size = std::cbrt(static_cast<double>(beads));
  for (BeadId b = 0; b < beads; ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      motion.set_coordinate(b, 0, axis, uniform(random, 0, size));
      motion.set_coordinate(b, 1, axis, motion.coordinate(b, 0, axis) + uniform(random, -0.1, 0.1));
    }
    for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weight * (b % 7));
  }
  return motion;
}

/// Finds the neighbours by a scan of all cells.
std::vector<BeadId> scanned_neighbors(const PowerDiagram<3>& diagram, BeadId bead) {
  std::vector<BeadId> neighbors;
  for (const CellBeads<3>& cell : diagram.at_frame(false).cells) {
    if (std::find(cell.begin(), cell.end(), bead) == cell.end()) continue;
    std::copy_if(cell.begin(), cell.end(), std::back_inserter(neighbors),
                 [&](BeadId b) { return b != bead; });
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return neighbors;
}

TEST(PowerDiagramEdits, NeighborsAreThoseOfTheCellsNow) {
  Rig<Diagram<Space>, Space> rig(random_space(60, 1, 0.15));
  auto& diagram = rig.structure;
  EXPECT_THROW(static_cast<void>(diagram.neighbors(3)), std::logic_error);
  rig.simulator.build();
  rig.simulator.enter_step();
  std::size_t hidden = 0, edges = 0;
  for (int event = 0; event < 40 && rig.simulator.run_next(); ++event) {
    if (event == 20) diagram.erase(7);
    for (BeadId bead = 0; bead < 60; ++bead) {
      if (diagram.is_absent(bead)) continue;
      const std::vector<BeadId> neighbors = diagram.neighbors(bead);
      ASSERT_EQ(neighbors, scanned_neighbors(diagram, bead)) << "bead " << bead << ", event " << event;
      for (const BeadId other : neighbors) EXPECT_THAT(diagram.neighbors(other), testing::Contains(bead));
      EXPECT_EQ(neighbors.empty(), diagram.hidden().contains(bead));
      hidden += neighbors.empty() ? 1 : 0;
      edges += neighbors.size();
    }
  }
  EXPECT_GT(hidden, 0U);
  EXPECT_GT(edges, 20000U);
  expect_edit_refused([&] { static_cast<void>(diagram.neighbors(7)); }, "bead 7 is not among its beads");
  expect_edit_refused([&] { static_cast<void>(diagram.neighbors(60)); },
                      "there is no bead 60: there are 60, numbered 0 to 59");
}

TEST(PowerDiagramEdits, NeighborsOfBeadsInOnePlaneAreRefused) {
  Space motion = random_space(8, 1, 0);
  for (BeadId b = 0; b < 8; ++b)
    for (int k = 0; k < 2; ++k) motion.set_coordinate(b, k, 2, 0);
  Rig<Diagram<Space>, Space> rig(motion);
  rig.simulator.build();
  EXPECT_THROW(static_cast<void>(rig.structure.neighbors(3)), std::logic_error);
}

TEST(PowerDiagramEdits, RefusesBadCalls) {
  Rig<Diagram<Space>, Space> rig(random_space(6, 1, 0));
  auto& diagram = rig.structure;
  diagram.leave_out(5);
  expect_edit_refused([&] { diagram.leave_out(5); }, "bead 5 is not among its beads");
  expect_edit_refused([&] { diagram.leave_out(6); }, "there is no bead 6");
  rig.simulator.build();
  expect_edit_refused([&] { diagram.leave_out(4); }, "before it is built");
  expect_edit_refused([&] { diagram.insert(5); }, "only within a step");
  rig.simulator.enter_step();
  rig.simulator.run_until(Dyadic(0.5));
  expect_edit_refused([&] { diagram.insert(4); }, "bead 4 is among its beads already");
  expect_edit_refused([&] { diagram.insert(6); }, "there is no bead 6");
  expect_edit_refused([&] { diagram.insert(5, 7); }, "there is no bead 7");
  expect_edit_refused([&] { diagram.insert(5, 5); }, "bead 5 is not among its beads");
  expect_edit_refused([&] { diagram.erase(5); }, "bead 5 is not among its beads");
  expect_edit_refused([&] { diagram.erase(no_bead); }, "there is no bead");
  expect_edit_refused([&] { diagram.change_motion(5, [] { FAIL(); }); }, "bead 5 is not among its beads");
  diagram.erase(4);
  expect_edit_refused([&] { diagram.erase(3); }, "at least 4 beads");
  diagram.insert(5);
  diagram.insert(4);
  rig.simulator.leave_step();
  expect_edit_refused([&] { diagram.erase(3); }, "only within a step");
  EXPECT_EQ(diagram.statistics.events_by_kind[Diagram<Space>::inserts], 2U);
  EXPECT_EQ(diagram.statistics.events_by_kind[Diagram<Space>::erases], 1U);
}

// A large bead is inserted and erased: the beads that it hides become visible again.
TEST(PowerDiagramEdits, HidesAndShows) {
  Space motion = random_space(60, 2, 0);
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k <= 1; ++k) motion.set_coordinate(30, k, axis, 2);
  }
  for (int k = 0; k <= 1; ++k) motion.set_weight(30, k, 4);
  Rig<Diagram<Space>, Space> rig(motion, AuditMode::events);
  rig.structure.leave_out(30);
  rig.simulator.build();
  const auto cells = rig.structure.at_frame(true).cells;
  EXPECT_TRUE(rig.structure.at_frame(true).hidden.empty());
  rig.simulator.enter_step();
  rig.simulator.run_until(Dyadic(0x1p-40));
  rig.structure.insert(30);
  rig.simulator.run_until(Dyadic(0x1p-39));
  EXPECT_GT(rig.structure.at_frame(true).hidden.size(), 5U);
  const BeadId hidden = rig.structure.at_frame(true).hidden[0];
  rig.structure.erase(hidden);
  rig.structure.insert(hidden, 30);
  rig.simulator.run_until(Dyadic(0x1p-38));
  rig.structure.erase(30);
  EXPECT_EQ(rig.structure.at_frame(true).cells, cells);
  EXPECT_TRUE(rig.structure.at_frame(true).hidden.empty());
  EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
  rig.simulator.leave_step();
}

TEST(PowerDiagramEdits, AreReplayed) {
  for (const double weight : {0.0, 0.2}) {
    std::vector<Space> steps{random_space(80, 3, weight), random_space(80, 4, weight)};
    for (BeadId b = 0; b < 80; ++b) {  // the second step starts where the first ends
      for (int axis = 0; axis < 3; ++axis) {
        const double moves = steps[1].coordinate(b, 1, axis) - steps[1].coordinate(b, 0, axis);
        const double x = steps[0].coordinate(b, 1, axis);
        steps[1].set_coordinate(b, 0, axis, x);
        steps[1].set_coordinate(b, 1, axis, x + moves);
      }
    }
    Rig<Diagram<Space>, Space> rig(steps[0]), again(steps[0]);
    for (auto* r : {&rig, &again}) {
      for (BeadId b = 0; b < 20; ++b) r->structure.leave_out(b);
    }
    rig.simulator.build();
    Random random(5);
    for (std::size_t step = 0; step < 2; ++step) {
      rig.motion = steps[step];
      rig.simulator.enter_step();
      for (int k = 1; k < 32; ++k) {
        rig.simulator.run_until(Dyadic(k / 32.0));
        const BeadId b = random() % 40;
        if (rig.structure.is_absent(b)) {
          rig.structure.insert(b);
        } else {
          rig.structure.erase(b);
        }
        rig.structure.change_motion(50, [] {});
      }
      rig.simulator.leave_step();
    }
    rig.simulator.finish();
    again.replay(steps, rig.history);
    EXPECT_EQ(again.simulator.fingerprint(), rig.simulator.fingerprint());
    EXPECT_EQ(again.history.events.size(), rig.history.events.size());
    EXPECT_EQ(again.structure.at_frame(false).cells, rig.structure.at_frame(false).cells);
    EXPECT_EQ(again.structure.at_frame(false).hidden, rig.structure.at_frame(false).hidden);
    EXPECT_EQ(again.structure.statistics.events_by_kind, rig.structure.statistics.events_by_kind);
    std::uint64_t external = 0;
    for (std::size_t kind = 0; kind < Diagram<Space>::wanders; ++kind)
      external += rig.structure.statistics.events_by_kind[kind];
    EXPECT_EQ(rig.external_events(), external);  // edits are counted separately
    EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
  }
}

TEST(PowerDiagramEdits, ReplayRefusesWhatDoesNotFit) {
  Rig<Diagram<Space>, Space> rig(random_space(20, 3, 0));
  rig.simulator.build();
  rig.simulator.enter_step();
  rig.simulator.run_until(Dyadic(0.5));
  const std::size_t before = rig.history.events.size();
  rig.structure.erase(7);
  std::vector<Change> edit;
  for (std::size_t e = before; e < rig.history.events.size(); ++e)
    edit.push_back(rig.history.events[e].change);
  for (std::size_t spoiled = 0; spoiled < edit.size(); ++spoiled) {
    for (const bool left_out : {true, false}) {
      Rig<Diagram<Space>, Space> again(random_space(20, 3, 0));
      again.simulator.build();
      for (std::size_t e = 0; e < before; ++e) again.structure.apply(rig.history.events[e].change);
      const auto replay = [&] {
        for (std::size_t e = 0; e < edit.size(); ++e) {
          Change change = edit[e];
          if (e == spoiled && left_out) continue;
          if (e == spoiled) std::swap(change.ids[0], change.ids[1]);  // opposite orientation, or not a bead
          again.structure.apply(change);
        }
      };
      const bool harmless =
          edit[spoiled].kind == Diagram<Space>::clears ? !left_out : spoiled + 1 == edit.size();
      if (!harmless) {
        EXPECT_THROW(replay(), std::invalid_argument) << spoiled;
      }
    }
  }
}

// The number of certificates and signs depends on the degree of the edited bead, not on the size of the
// diagram.
TEST(PowerDiagramEdits, CostFollowsTheDegree) {
  std::array<double, 2> certificates{}, signs{};
  for (std::size_t large = 0; large < 2; ++large) {
    const std::size_t beads = large == 0 ? 300 : 3000;
    Rig<Diagram<Space>, Space> rig(random_space(beads, 9, 0));
    rig.simulator.build();
    rig.simulator.enter_step();
    rig.simulator.run_until(Dyadic(0.5));
    const StructureStatistics& s = rig.structure.statistics;
    const auto signs_taken = [&] { return s.stages.signs_double + s.stages.signs_exact; };
    const std::uint64_t certificates_before = s.certificates.created, signs_before = signs_taken();
    constexpr int edits = 100;
    for (BeadId b = 0; b < edits; ++b) {
      // The nearest bead serves as the hint for the search.
      rig.structure.erase(100 + b);
      BeadId near = no_bead;
      double least = 1e300;
      for (BeadId c = 0; c < beads; ++c) {
        double square = 0;
        for (int axis = 0; axis < 3; ++axis)
          square += std::pow(rig.motion.coordinate(c, 0, axis) - rig.motion.coordinate(100 + b, 0, axis), 2);
        if (c != 100 + b && square < least) {
          least = square;
          near = c;
        }
      }
      rig.structure.insert(100 + b, near);
    }
    certificates[large] = static_cast<double>(s.certificates.created - certificates_before) / edits;
    signs[large] = static_cast<double>(signs_taken() - signs_before) / edits;
    EXPECT_EQ(s.rebuilds, 0U);
    rig.simulator.leave_step();
  }
  EXPECT_LT(certificates[1], 1.3 * certificates[0]);
  EXPECT_LT(signs[1], 1.3 * signs[0]);
  EXPECT_LT(certificates[1], 200);
}

// Facets rest for steps ahead while beads go straight on. A detour within a step, after which a bead is back
// on its old course, ends that rest.
TEST(PowerDiagramEdits, FacetsDoNotRestAcrossADetour) {
  for (unsigned seed = 0; seed < rounds(3U); ++seed) {
    SCOPED_TRACE(seed);
    constexpr std::size_t beads = 40, count = 10;
    Random random(seed);
    std::vector<Space> steps(count, Space(beads));
    for (BeadId b = 0; b < beads; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        double place = 0x1p-12 * pick(random, 0, 4095);
        const double velocity = random() % 5 == 0 ? 0 : 0x1p-12 * pick(random, -160, 160);
        for (Space& step : steps) {
          step.set_coordinate(b, 0, axis, place);
          place += velocity;
          step.set_coordinate(b, 1, axis, place);
        }
      }
    }
    std::vector<std::uint64_t> fingerprints;
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      Rig<PowerDiagram<3>, Space> rig(steps.front(), AuditMode::events, kernel);
      rig.simulator.build();
      for (std::size_t k = 0; k < count; ++k) {
        rig.motion = steps[k];
        rig.simulator.enter_step();
        const auto bead = static_cast<BeadId>(seed + k);
        const auto bend_by = [&](double by) {
          rig.structure.change_motion(bead, [&] {
            rig.motion.set_coordinate(bead, 0, 0, steps[k].coordinate(bead, 0, 0) - by);
            rig.motion.set_coordinate(bead, 1, 0, steps[k].coordinate(bead, 1, 0) + by);
          });
        };
        if (k % 3 == 1) {
          rig.simulator.run_until(Dyadic(0.5));
          bend_by(0.25);
          rig.simulator.run_until(Dyadic(0.75));
          bend_by(0);
        }
        rig.simulator.leave_step();
      }
      rig.simulator.finish();
      fingerprints.push_back(rig.simulator.fingerprint());
    }
    EXPECT_EQ(fingerprints[0], fingerprints[1]);
  }
}

}  // namespace
}  // namespace kds::power_diagram_edits_test
