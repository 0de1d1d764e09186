#include "structures/dual_complex/dual_complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "motions/curves/bezier_motion.h"
#include "structures/power_diagram/power_diagram.h"
#include "tests/support/judges/cgal_triangulation.h"
#include "tests/support/judges/exact_checks.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"

namespace kds::test {
namespace {

using Simplices = std::vector<SimplexBeads>;

Simplices all_simplices(const DualComplex<3>& complex) {
  Simplices all;
  for (int dimension = 0; dimension <= 3; ++dimension)
    for (const SimplexBeads& simplex : complex.simplices(dimension)) all.push_back(simplex);
  std::sort(all.begin(), all.end());
  return all;
}

/// Beads with whole coordinates below 1000 and radii of 50 to 450, so that most scenes are in general
/// position and have balls inside each other, apart and overlapping.
BezierMotion<3, 1> random_balls(std::mt19937& random) {
  BezierMotion<3, 1> motion(5 + random() % 5);
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const double radius = 50 + static_cast<double>(random() % 400);
    for (int k = 0; k <= 1; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, k, axis, static_cast<double>(random() % 1000));
      motion.set_weight(b, k, radius * radius);
    }
  }
  return motion;
}

TEST(DualComplex, EqualsAlphaShapesOfCgalAfterEveryEvent) {
  std::mt19937 random(static_cast<std::uint32_t>(from_environment("KDS_DUAL_SEED", 20261130)));
  std::size_t compared = 0, begun = 0;
  for (std::size_t round = 0; round < rounds(40, 4) * from_environment("KDS_DUAL_ROUNDS", 1); ++round) {
    const BezierMotion<3, 1> motion = random_balls(random);
    Simulator simulator(AuditMode::events);
    PowerDiagram<3> diagram(simulator, motion);
    DualComplex<3> complex(simulator, motion, diagram);
    simulator.build();
    ASSERT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, Dyadic(0.0))));
    simulator.enter_step();
    do {
      const Dyadic soon = next_on_grid(simulator.now().exact(), 60);
      if (!(soon < Dyadic(1.0))) break;
      simulator.run_until(soon);
      ASSERT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, soon)))
          << "round " << round << " at u = " << soon.round_down();
      ++compared;
    } while (simulator.run_next());
    simulator.leave_step();
    for (int dimension = 0; dimension <= 3; ++dimension)
      begun += complex.statistics.events_by_kind[DualComplex<3>::begins(dimension)];
  }
  EXPECT_GT(compared, rounds(40, 4) * 10);
  EXPECT_GT(begun, rounds(40, 4) * 10);
}

TEST(DualComplex, IsBuiltAgainAtAnotherPosition) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    BezierMotion<3, 1> motion = random_balls(random);
    Simulator simulator(AuditMode::events);
    PowerDiagram<3> diagram(simulator, motion);
    DualComplex<3> complex(simulator, motion, diagram);
    simulator.build();
    simulator.run_step();
    for (BeadId b = 0; b < motion.bead_count(); ++b)
      for (int axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, 0, axis, static_cast<double>(random() % 1000));
    simulator.build();
    EXPECT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, Dyadic(0.0))));
    simulator.run_step();
    EXPECT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, Dyadic(1.0))));
  }
}

}  // namespace
}  // namespace kds::test
