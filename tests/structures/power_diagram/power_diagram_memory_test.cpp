// Measures, with a counting allocator, the memory of a running power diagram beyond CGAL's triangulation of
// the same beads.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include "kds/simulator.h"
#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/cgal_triangulations.h"
#include "tests/support/inputs/random_motion.h"

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
#include <malloc.h>

namespace kds::power_diagram_memory_test {
namespace {

using namespace test;
using Space = BezierMotion<3, 1>;

double bytes_allocated() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

double bytes_of_cgal(const Space& motion) {
  using Cgal = CgalTriangulation<CGAL::Exact_predicates_inexact_constructions_kernel, 3>;
  std::vector<std::pair<Cgal::Type::Weighted_point, BeadId>> points;
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const double* c = motion.control_point(b, 0);
    points.emplace_back(Cgal::Type::Weighted_point(Cgal::point(c[0], c[1], c[2]), c[3]), b);
  }
  const double before = bytes_allocated();
  Cgal::Type triangulation;
  triangulation.insert(points.begin(), points.end());
  return bytes_allocated() - before;
}

/// Replaces the motion by a step that starts where the present step ends. Each coordinate moves by at most
/// `step`.
void move_on(Space& motion, Random& random, double step) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = motion.coordinate(b, 1, axis);
      motion.set_coordinate(b, 0, axis, x);
      motion.set_coordinate(b, 1, axis, x + uniform(random, -step, step));
    }
  }
}

TEST(PowerDiagramMemory, IsBelowOneAndAHalfKilobytesABead) {
  constexpr BeadId beads = 10240;
  for (const double step : {0.001, 0.01, 0.1}) {
    for (const double weight : {0.0, 0.3}) {
      Random random(1);
      Space motion(beads);
      for (BeadId b = 0; b < beads; ++b) {
        for (int axis = 0; axis < 3; ++axis)
          motion.set_coordinate(b, 1, axis, uniform(random, 0, std::cbrt(beads)));
        const double w = weight * uniform(random, 0, 1);
        for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, w);
      }
      move_on(motion, random, step);
      const double cgal = bytes_of_cgal(motion);
      const double before = bytes_allocated();
      Simulator simulator;
      PowerDiagram<3> diagram(simulator, motion);
      simulator.build();
      double most = 0;
      for (int k = 0; k < 4; ++k) {
        simulator.enter_step();
        for (int eighth = 0; eighth < 8; ++eighth) {
          most = std::max(most, bytes_allocated() - before);
          simulator.run_until(Dyadic(eighth / 8.0));
        }
        simulator.leave_step();
        most = std::max(most, bytes_allocated() - before);
        move_on(motion, random, step);
      }
      const double beyond = (most - cgal) / beads;
      RecordProperty("bytes_a_bead", std::to_string(beyond));
      std::cout << "step " << step << ", weights to " << weight << ": " << std::lround(beyond)
                << " bytes a bead beyond " << std::lround(cgal / beads) << " of CGAL's triangulation\n";
      EXPECT_GT(cgal / beads, 500);
      EXPECT_GT(beyond, 100);
      EXPECT_LT(beyond, 1500);
      EXPECT_EQ(diagram.statistics.rebuilds, 0U);
    }
  }
}

}  // namespace
}  // namespace kds::power_diagram_memory_test

#endif
