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

enum class Scene { generic, weighted, grid, grid_at_rest, line };
constexpr std::array all_scenes{Scene::generic, Scene::weighted, Scene::grid, Scene::grid_at_rest,
                                Scene::line};

/// Sets a curve whose coordinates have few bits, so that it can be bent without rounding.
template <class M>
void set_curve(M& motion, BeadId b, Random& random, Scene scene) {
  const bool grid = scene == Scene::grid || scene == Scene::grid_at_rest;
  for (int axis = 0; axis < M::dimension; ++axis) {
    for (int k = 0; k <= M::degree; ++k) {
      double x = grid ? pick(random, -2, 2) : 0x1p-20 * pick(random, -(1 << 20), 1 << 20);
      if (k > 0 && scene == Scene::grid_at_rest) x = motion.coordinate(b, 0, axis);
      if (k > 0 && scene == Scene::weighted) x = motion.coordinate(b, 0, axis) + 0.25 * x;
      if (scene == Scene::line && axis > 0 && k == 0) x = 0;  // on the line at the start only
      motion.set_coordinate(b, k, axis, x);
    }
  }
  for (int k = 0; k <= M::degree; ++k) {
    double w = 0;
    if (scene == Scene::weighted) {
      const bool heavy = random() % 3 == 0;
      w = 0x1p-20 * (random() % (heavy ? 1U << 22U : 1U << 18U));
    }
    motion.set_weight(b, k, w);
  }
}

struct Totals {
  std::uint64_t inserts = 0, erases = 0, changes = 0, rebuilds = 0, hidden = 0;
};

/// Makes edits at 16 times of each of two steps, one or a few at a time.
template <class M>
void run(unsigned seed, Scene scene, Totals& totals) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", scene " << static_cast<int>(scene));
  Random random(1000 * seed + static_cast<unsigned>(scene));
  const auto beads = static_cast<BeadId>(M::dimension + 8 + random() % 12);
  M motion(beads);
  for (BeadId b = 0; b < beads; ++b) set_curve(motion, b, random, scene);
  Simulator simulator(AuditMode::events);
  Diagram<M> diagram(simulator, motion);
  History history;
  simulator.listen(history);
  for (BeadId b = 0; b + M::dimension + 4 < beads; b += 2) diagram.leave_out(b);
  std::vector<BeadId> present;
  const auto count_present = [&] {
    present.clear();
    for (BeadId b = 0; b < beads; ++b) {
      if (!diagram.is_absent(b)) present.push_back(b);
    }
  };
  simulator.build();
  for (int step = 0; step < 2; ++step) {
    if (step == 1) {
      for (BeadId b = 0; b < beads; ++b) {
        for (int axis = 0; axis < M::dimension; ++axis) {
          const double x = motion.coordinate(b, 1, axis);
          motion.set_coordinate(b, 0, axis, x);
          motion.set_coordinate(
              b, 1, axis, x + (scene == Scene::grid ? pick(random, -1, 1) : 0x1p-8 * pick(random, -64, 64)));
        }
        motion.set_weight(b, 0, motion.weight(b, 1));
      }
    }
    simulator.enter_step();
    for (int sixteenth = 1; sixteenth < 16; ++sixteenth) {
      const double u = sixteenth / 16.0;
      for (unsigned k = 0; k < 1 + random() % 3; ++k) {
        simulator.run_until(Dyadic(u + 0x1p-12 * k));  // audits the edit before
        count_present();
        const auto b = static_cast<BeadId>(random() % beads);
        if (diagram.is_absent(b)) {
          if (random() % 3 == 0) set_curve(motion, b, random, scene);
          diagram.insert(b, random() % 2 == 0 ? no_bead : present[random() % present.size()]);
        } else if (random() % 2 == 0 && present.size() > M::dimension + 3) {
          try {
            diagram.erase(b);
          } catch (const std::invalid_argument& refusal) {
            // The beads left would stay in one plane, or on one line.
            EXPECT_TRUE(scene == Scene::grid || scene == Scene::grid_at_rest) << refusal.what();
            EXPECT_FALSE(diagram.is_absent(b));
          }
        } else if (k == 0 && random() % 2 == 0) {
          diagram.change_motion(b, [&] { bend(motion, b, u, random); });
        } else {
          diagram.change_motion(b, [&] { set_curve(motion, b, random, scene); });
        }
      }
    }
    simulator.leave_step();
  }
  simulator.finish();
  EXPECT_TRUE(books_balance(diagram.statistics));
  const auto& kinds = diagram.statistics.events_by_kind;
  totals.inserts += kinds[Diagram<M>::inserts];
  totals.erases += kinds[Diagram<M>::erases];
  totals.changes += kinds[Diagram<M>::changes];
  totals.rebuilds += diagram.statistics.rebuilds;
  // Edits of hidden beads do not exchange cells.
  for (std::size_t e = 0; e < history.events.size(); ++e) {
    const auto kind = history.events[e].change.kind;
    const bool edits = kind == Diagram<M>::inserts || kind == Diagram<M>::erases;
    totals.hidden += edits && (e == 0 || history.events[e - 1].change.kind != Diagram<M>::fills) ? 1 : 0;
  }
}

template <class M>
void run_all(unsigned seeds) {
  for (const Scene scene : all_scenes) {
    Totals totals;
    for (unsigned seed = 0; seed < seeds && !testing::Test::HasFailure(); ++seed) {
      try {
        run<M>(seed, scene, totals);
      } catch (const InputError&) {  // the beads left are in one plane, or on one line
        EXPECT_TRUE(scene == Scene::grid || scene == Scene::grid_at_rest);
      } catch (const std::exception& error) {
        FAIL() << "seed " << seed << ", scene " << static_cast<int>(scene) << ": " << error.what();
      }
    }
    EXPECT_GT(totals.inserts, 10 * seeds);
    EXPECT_GT(totals.erases, 10 * seeds);
    EXPECT_GT(totals.changes, 5 * seeds);
    if (scene == Scene::generic || scene == Scene::weighted) {
      EXPECT_EQ(totals.rebuilds, 0U);
    }
    if (scene == Scene::weighted) {
      EXPECT_GT(totals.hidden, seeds);
    }
  }
}

TEST(PowerDiagramEdits, InSpace) { run_all<Space>(test::rounds(12U)); }
TEST(PowerDiagramEdits, InThePlane) { run_all<BezierMotion<2, 1>>(test::rounds(12U)); }
TEST(PowerDiagramEdits, UnderLiftedMotion) { run_all<LiftedMotion<3>>(test::rounds(3U)); }

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

/// Runs inserts, erases and bends under one kernel.
std::pair<std::uint64_t, std::uint64_t> run_kernel(Kernel kernel) {
  using Plane = BezierMotion<2, 1>;
  Random random(77);
  Plane motion(30);
  for (BeadId b = 0; b < 30; ++b) set_curve(motion, b, random, Scene::weighted);
  Simulator simulator(AuditMode::none, kernel);
  PowerDiagram<2> diagram(simulator, motion);
  for (BeadId b = 0; b < 10; ++b) diagram.leave_out(b);
  simulator.build();
  simulator.enter_step();
  for (int k = 1; k < 16; ++k) {
    simulator.run_until(Dyadic(k / 16.0));
    const BeadId b = random() % 20;
    if (diagram.is_absent(b)) {
      diagram.insert(b);
    } else {
      diagram.erase(b);
    }
    diagram.change_motion(25, [&] { bend(motion, 25, k / 16.0, random); });
  }
  simulator.leave_step();
  EXPECT_EQ(diagram.statistics.rebuilds, 0U);
  return {simulator.fingerprint(), diagram.statistics.certificates.created};
}

TEST(PowerDiagramEdits, KernelsAgree) { EXPECT_EQ(run_kernel(Kernel::exact), run_kernel(Kernel::filtered)); }

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

}  // namespace
}  // namespace kds::power_diagram_edits_test
