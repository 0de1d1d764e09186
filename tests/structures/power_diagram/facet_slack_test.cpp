// A facet that rests in a step, judged on integers, does not fail in it.

#include "structures/power_diagram/facet_slack.h"

#include <gtest/gtest.h>

#include <vector>

#include "certificates/search/failure_search.h"
#include "motions/curves/positions.h"
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
  FacetSlack<M> tolerances;
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
    if (!tolerances.any()) continue;
    std::vector<unsigned> others(triangulation.cells().size(), 0);
    tolerances.for_the_others(triangulation, [&](CellId cell, unsigned facets) {
      EXPECT_EQ(others[cell], 0U);
      EXPECT_NE(facets, 0U);
      others[cell] = facets;
    });
    for (CellId id = 0; id < others.size(); ++id) {
      const auto& cell = triangulation.cells()[id];
      for (int i = 0; i <= dimension; ++i) {
        const bool other = (others[id] >> i & 1U) != 0;
        if (cell_of(triangulation.beyond(id, i)) < id) {
          EXPECT_FALSE(other);  // it is met at the other cell
          continue;
        }
        ++all;
        if (other) continue;
        ++resting;
        with_facet_certificate(cell.vertex, triangulation.apex_beyond(id, i), [&](const auto& certificate) {
          EXPECT_EQ(
              (first_failure<Exact>(certificate, motion, Instant(0), KnownAtStart::unknown, stages).kind),
              Failure::Kind::never);
        });
      }
    }
    // What is forgotten, at both cells, is looked at, once.
    const auto [other, k] =
        std::pair(cell_of(triangulation.beyond(0, 0)), index_of(triangulation.beyond(0, 0)));
    tolerances.forget(0, 0);
    tolerances.forget(other, k);
    unsigned times = 0;
    tolerances.for_the_others(triangulation, [&](CellId cell, unsigned facets) {
      times += cell == 0 ? facets & 1U : 0;
      if (cell == other) {
        EXPECT_EQ(facets >> k & 1U, 0U);
      }
    });
    EXPECT_EQ(times, 1U);
  }
  EXPECT_GE(static_cast<double>(resting), least_share * static_cast<double>(all));
  EXPECT_EQ(all > 0, least_share > 0);
}

TEST(FacetSlack, HoldWhereBeadsStrayLess) {
  expect_resting_to_hold<3>(1e-6, 0.9);
  expect_resting_to_hold<3>(1e-4, 0.5);
  expect_resting_to_hold<3>(0.1, 0);  // too fast to take any
  expect_resting_to_hold<2>(1e-5, 0.9);
}

}  // namespace
}  // namespace kds
