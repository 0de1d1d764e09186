// Beads keep their velocities for several steps. Facets that were examined ahead rest, and all events agree
// with the exact kernel, which examines every facet in each step.

#include <cmath>

#include "tests/structures/power_diagram/audited_diagram.h"
#include "tests/support/rounds.h"

namespace kds::straight_diagram_test {
namespace {

using namespace test;

/// Parameters of the motion. Coordinates and velocities are multiples of `unit`. If few values are possible,
/// many events are simultaneous, also exactly where steps meet.
struct Walk {
  double unit = 0x1p-12;
  int range = 1 << 12, fastest = 160;  // multiples of `unit`
  double turning = 0.1;                // share of beads that change velocity from step to step
  double at_rest = 0.2;                // share of these beads that come to rest
  bool radii = false;
};

template <class M>
std::vector<M> steps_of(const Walk& walk, std::size_t beads, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  const auto any = [&](int most) {
    return walk.unit * static_cast<int>(random() % static_cast<unsigned>(most));
  };
  std::vector<M> steps(count, M(beads));
  for (BeadId b = 0; b < beads; ++b) {
    std::array<double, 3> place{any(walk.range), any(walk.range), any(walk.range)}, velocity{};
    const double weight = walk.radii ? 0.02 * share(random) : 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (k == 0 || share(random) < walk.turning) {
        const bool rests = share(random) < walk.at_rest;
        for (double& v : velocity) v = rests ? 0 : any(2 * walk.fastest + 1) - walk.unit * walk.fastest;
      }
      for (std::size_t axis = 0; axis < M::dimension; ++axis) {
        steps[k].set_coordinate(b, 0, static_cast<int>(axis), place[axis]);
        place[axis] += velocity[axis];
        steps[k].set_coordinate(b, 1, static_cast<int>(axis), place[axis]);
      }
      for (const int end : {0, 1}) steps[k].set_weight(b, end, weight);
    }
  }
  return steps;
}

template <class M>
using RigOf = Rig<PowerDiagram<M::dimension>, M>;

/// Returns the number of facets that rested.
template <class M>
std::uint64_t expect_as_exact(const std::vector<M>& steps, AuditMode audits) {
  RigOf<M> rig(steps.front(), audits);
  rig.run(steps);
  RigOf<M> exact(steps.front(), AuditMode::none, Kernel::exact);
  exact.run(steps);
  EXPECT_EQ(rig.simulator.fingerprint(), exact.simulator.fingerprint());
  EXPECT_EQ(rig.history.events.size(), exact.history.events.size());
  EXPECT_GT(rig.external_events(), 0U);
  const auto &counts = rig.structure.statistics.certificates,
             &of_exact = exact.structure.statistics.certificates;
  EXPECT_EQ(counts.created, of_exact.created);
  EXPECT_EQ(counts.never_failing, of_exact.never_failing);
  EXPECT_EQ(counts.failed, of_exact.failed);
  EXPECT_EQ(rig.structure.statistics.rebuilds, exact.structure.statistics.rebuilds);
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  return rig.structure.statistics.stages.slack;
}

template <class M>
void expect_as_exact_however_many_turn() {
  for (unsigned seed = 0; seed < rounds(8U, 2U); ++seed) {
    SCOPED_TRACE(seed);
    Walk walk;
    walk.turning = std::array{0.0, 0.04, 0.1, 0.9}[seed % 4];
    walk.radii = seed % 3 == 0;
    const auto steps = steps_of<M>(walk, 45, rounds(14U, 6U), seed);
    const std::uint64_t rested = expect_as_exact(steps, seed < 4 ? AuditMode::events : AuditMode::frames);
    if (walk.turning <= 0.1) {
      EXPECT_GT(rested, 0U);
    }
  }
}

TEST(PowerDiagram, FacetsOfBeadsThatGoStraightOnRest) {
  expect_as_exact_however_many_turn<BezierMotion<3, 1>>();
  expect_as_exact_however_many_turn<BezierMotion<2, 1>>();
}

// Events where steps meet, where beads turn, and at other shared times.
TEST(PowerDiagram, FacetsRestAlsoWhereMuchHappensAtOnce) {
  for (unsigned seed = 0; seed < rounds(12U, 2U); ++seed) {
    SCOPED_TRACE(seed);
    const Walk walk{1, 6, 1, seed % 2 == 0 ? 0.1 : 0.02, 0.5, false};
    const auto steps = steps_of<BezierMotion<3, 1>>(walk, 24, 9, seed);
    static_cast<void>(run_audited(steps, false));
    const auto in_plane = steps_of<BezierMotion<2, 1>>(walk, 14, 9, seed);
    RigOf<BezierMotion<2, 1>> rig(in_plane.front(), AuditMode::events);
    rig.run(in_plane);
    EXPECT_TRUE(books_balance(rig.structure.statistics));
  }
}

// Coordinates far beyond the precision of double round each step, so no bead is known to keep its velocity.
TEST(PowerDiagram, WhatIsRoundedDoesNotRest) {
  auto steps = steps_of<BezierMotion<3, 1>>({}, 30, 8, 5);
  for (auto& step : steps)
    for (BeadId b = 0; b < step.bead_count(); ++b)
      for (const int end : {0, 1})
        for (int axis = 0; axis < 3; ++axis)
          step.set_coordinate(b, end, axis, step.coordinate(b, end, axis) / 3);
  expect_as_exact(steps, AuditMode::events);
}

// A change of course within a step invalidates everything known about the bead, even if the bead returns to
// its old course.
TEST(PowerDiagram, FacetsDoNotRestAcrossAChangeOfCourse) {
  using M = BezierMotion<3, 1>;
  for (unsigned seed = 0; seed < rounds(3U); ++seed) {
    SCOPED_TRACE(seed);
    Walk walk;
    walk.turning = 0;
    const auto steps = steps_of<M>(walk, 40, 10, seed);
    std::vector<std::uint64_t> fingerprints;
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      RigOf<M> rig(steps.front(), AuditMode::events, kernel);
      rig.simulator.build();
      for (std::size_t k = 0; k < steps.size(); ++k) {
        rig.motion = steps[k];
        rig.simulator.enter_step();
        if (k % 3 == 1) {
          rig.simulator.run_until(Dyadic(0.5));
          const BeadId bead = static_cast<BeadId>(seed + k);
          // The bead moves twice as far as before and then back, so it ends where it would have ended.
          const auto bend = [&](double by) {
            rig.structure.change_motion(bead, [&] {
              for (const int end : {0, 1})
                rig.motion.set_coordinate(bead, end, 0,
                                          steps[k].coordinate(bead, end, 0) + (end == 0 ? -by : by));
            });
          };
          bend(0.25);
          rig.simulator.run_until(Dyadic(0.75));
          bend(0);
        }
        rig.simulator.leave_step();
      }
      rig.simulator.finish();
      fingerprints.push_back(rig.simulator.fingerprint());
    }
    EXPECT_EQ(fingerprints[0], fingerprints[1]);
  }
}

// Beads are inserted and erased while others keep their velocities. Facts about facets that stay must not be
// used for new facets.
TEST(PowerDiagram, FacetsRestWhileBeadsComeAndGo) {
  using M = BezierMotion<3, 1>;
  for (unsigned seed = 0; seed < rounds(4U); ++seed) {
    SCOPED_TRACE(seed);
    Walk walk;
    walk.turning = seed % 2 == 0 ? 0 : 0.03;
    walk.radii = seed < 2;
    if (seed == 3) walk = {1, 6, 1, 0.02, 0.5, false};
    const auto steps = steps_of<M>(walk, 40, 10, seed);
    std::vector<std::uint64_t> fingerprints;
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      RigOf<M> rig(steps.front(), AuditMode::events, kernel);
      for (BeadId b = 0; b < 40; b += 5) rig.structure.leave_out(b);
      rig.simulator.build();
      std::mt19937 random(seed);
      for (const M& step : steps) {
        rig.motion = step;
        rig.simulator.enter_step();
        for (const double u : {0.25, 0.5, 0.75}) {
          rig.simulator.run_until(Dyadic(u));
          const auto bead = static_cast<BeadId>(random() % 40);
          if (rig.structure.is_absent(bead)) {
            rig.structure.insert(bead);
          } else {
            rig.structure.erase(bead);
          }
        }
        rig.simulator.leave_step();
      }
      rig.simulator.finish();
      fingerprints.push_back(rig.simulator.fingerprint());
      EXPECT_TRUE(books_balance(rig.structure.statistics));
      if (kernel == Kernel::filtered) {
        EXPECT_GT(rig.structure.statistics.stages.slack, 0U);
      }
    }
    EXPECT_EQ(fingerprints[0], fingerprints[1]);
  }
}

}  // namespace
}  // namespace kds::straight_diagram_test
