// A facet that rests in a step, judged on integers, does not fail in it.

#include "structures/facet_tolerances.h"

#include <gtest/gtest.h>

#include <vector>

#include "certificates/failure_search.h"
#include "motions/positions.h"
#include "tests/support/random_motion.h"

namespace kds {
namespace {

constexpr std::size_t beads = 150;

template <int dimension>
void expect_resting_to_hold(double distance, double least_share) {
  using M = BezierMotion<dimension, 1>;
  test::Random random(9);
  M motion(beads);
  for (BeadId b = 0; b < beads; ++b) {
    for (int axis = 0; axis < dimension; ++axis) motion.set_coordinate(b, 1, axis, test::uniform(random));
  }
  RegularTriangulation<dimension> triangulation;
  static_cast<void>(triangulation.build(control_points(motion, 1), control_weights(motion, 1)));
  FacetTolerances<M> tolerances;
  StageCounts stages;
  std::size_t resting = 0, all = 0;
  for (int step = 0; step < 4; ++step) {
    for (BeadId b = 0; b < beads; ++b) {
      for (int axis = 0; axis < dimension; ++axis) {
        const double x = motion.coordinate(b, 1, axis);
        motion.set_coordinate(b, 0, axis, x);
        motion.set_coordinate(b, 1, axis, x + distance * (1 + test::uniform(random)));  // and a drift
      }
    }
    tolerances.start_step(motion, triangulation);
    for (CellId id = 0; tolerances.any() && id < triangulation.cells().size(); ++id) {
      const auto& cell = triangulation.cells()[id];
      const unsigned rest = tolerances.resting(cell, id, (2U << dimension) - 1);
      for (int i = 0; i <= dimension; ++i) {
        ++all;
        EXPECT_EQ(tolerances.resting(cell, id, 1U << i), rest & 1U << i);
        if ((rest >> i & 1U) == 0) continue;
        ++resting;
        with_facet_certificate(cell.vertex, triangulation.apex_beyond(id, i), [&](const auto& certificate) {
          EXPECT_EQ((first_failure<Exact>(certificate, motion, Instant(0), Birth::unknown, stages).kind),
                    Failure::Kind::never);
        });
      }
    }
    tolerances.forget(0, 0);
    if (tolerances.any()) {
      EXPECT_EQ(tolerances.resting(triangulation.cells()[0], 0, 1), 0U);
    }
  }
  EXPECT_GE(static_cast<double>(resting), least_share * static_cast<double>(all));
  EXPECT_EQ(all > 0, least_share > 0);
}

TEST(FacetTolerances, HoldWhereBeadsStrayLess) {
  expect_resting_to_hold<3>(1e-6, 0.9);
  expect_resting_to_hold<3>(1e-4, 0.5);
  expect_resting_to_hold<3>(0.1, 0);  // too fast to take any
  expect_resting_to_hold<2>(1e-5, 0.9);
}

}  // namespace
}  // namespace kds
