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
#include "tests/support/text_of.h"

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

/// Sets the k-th control points: whole coordinates below `range`, and radii up to 2/5 of it, so that balls
/// lie inside each other, apart and overlapping. A range of 1000 gives general position, while many frames of
/// a range of 30 are degenerate: balls touch.
void set_frame(BezierMotion<3, 1>& motion, int k, std::mt19937& random, unsigned range) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const double radius = 1 + static_cast<double>(random() % (range * 2 / 5));
    for (int axis = 0; axis < 3; ++axis)
      motion.set_coordinate(b, k, axis, static_cast<double>(random() % range));
    motion.set_weight(b, k, radius * radius);
  }
}

/// Scenes of five to eight beads in one step or two. KDS_DUAL_SCENES sets their number. To repeat one scene,
/// set KDS_DUAL_SEED to its seed and KDS_DUAL_SCENES to 1.
TEST(DualComplex, EqualsAlphaShapesOfCgalAfterEveryEvent) {
  const auto first_seed = static_cast<std::uint32_t>(from_environment("KDS_DUAL_SEED", 20261130));
  const std::uint64_t scenes = from_environment("KDS_DUAL_SCENES", rounds(200));
  std::size_t compared = 0, changes = 0;
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    SCOPED_TRACE(text_of("seed ", first_seed + scene));
    std::mt19937 random(first_seed + scene);
    const unsigned range = random() % 2 == 0 ? 1000 : 30;
    const std::size_t steps = 1 + random() % 2;
    BezierMotion<3, 1> motion(5 + random() % 4);
    set_frame(motion, 0, random, range);
    set_frame(motion, 1, random, range);
    Simulator simulator;
    PowerDiagram<3> diagram(simulator, motion);
    DualComplex<3> complex(simulator, motion, diagram);
    simulator.build();
    for (std::size_t step = 0; step < steps; ++step) {
      simulator.enter_step();
      do {
        // The grid is so coarse that all coordinates and weights are doubles, which CGAL compares faster.
        const Dyadic soon = next_on_grid(simulator.now().exact(), 34);
        if (!(soon < Dyadic(1.0))) break;
        simulator.run_until(soon);
        ASSERT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, soon)))
            << "step " << step << " at u = " << soon.round_down();
        ++compared;
      } while (simulator.run_next());
      simulator.leave_step();
      for (BeadId b = 0; b < motion.bead_count(); ++b) {
        for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, 0, axis, motion.coordinate(b, 1, axis));
        motion.set_weight(b, 0, motion.weight(b, 1));
      }
      set_frame(motion, 1, random, range);
    }
    for (const std::uint64_t events : complex.statistics.events_by_kind) changes += events;
  }
  EXPECT_GT(compared, scenes);
  EXPECT_GE(changes, scenes);
}

TEST(DualComplex, IsBuiltAgainAtAnotherPosition) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    BezierMotion<3, 1> motion(5 + random() % 5);
    set_frame(motion, 0, random, 1000);
    set_frame(motion, 1, random, 1000);
    Simulator simulator;
    PowerDiagram<3> diagram(simulator, motion);
    DualComplex<3> complex(simulator, motion, diagram);
    simulator.build();
    simulator.run_step();
    set_frame(motion, 0, random, 1000);
    simulator.build();
    EXPECT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, Dyadic(0.0))));
    simulator.run_step();
    EXPECT_EQ(all_simplices(complex), cgal_alpha_complex(exact_points(motion, Dyadic(1.0))));
  }
}

}  // namespace
}  // namespace kds::test
