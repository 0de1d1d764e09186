// A facet that a step skips does not fail in the step, judged in integers.

#include "structures/power_diagram/facet_slack.h"

#include <gtest/gtest.h>

#include <concepts>
#include <vector>

#include "certificates/search/certificate_search.h"
#include "motions/curves/positions.h"
#include "structures/triangulation/facet_certificate.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::facet_slack_test {
namespace {

constexpr std::size_t beads = 150;

template <int dimension>
void expect_skipped_to_hold(double distance, double least_share) {
  using M = BezierMotion<dimension, 1>;
  test::Random random(9);
  M motion(beads);
  for (BeadId b = 0; b < beads; ++b) {
    for (int axis = 0; axis < dimension; ++axis) motion.set_coordinate(b, 1, axis, test::uniform(random));
  }
  RegularTriangulation<dimension> triangulation;
  static_cast<void>(triangulation.build(control_points(motion, 1), control_weights(motion, 1)));
  FacetSlack<dimension> slack;
  const MotionRef<dimension> any(motion);
  const auto power_tests = search_over<PowerTest<dimension>>(any);
  const auto orientations = search_over<Orientation<dimension>>(any);
  StageCounts stages;
  std::size_t skipped = 0, all = 0;
  for (int step = 0; step < 4; ++step) {
    for (BeadId b = 0; b < beads; ++b) {
      for (int axis = 0; axis < dimension; ++axis) {
        const double x = motion.coordinate(b, 1, axis);
        motion.set_coordinate(b, 0, axis, x);
        // Each bead moves by a random part and a common drift.
        motion.set_coordinate(b, 1, axis, x + distance * (1 + test::uniform(random)));
      }
    }
    slack.start_step(any.curves(), triangulation);
    if (!slack.any()) continue;
    std::vector<unsigned> others(triangulation.cells().size(), 0);
    slack.for_the_others(triangulation, [&](CellId cell, unsigned facets) {
      EXPECT_EQ(others[cell], 0U);
      EXPECT_NE(facets, 0U);
      others[cell] = facets;
    });
    for (CellId id = 0; id < others.size(); ++id) {
      const auto& cell = triangulation.cells()[id];
      for (int i = 0; i <= dimension; ++i) {
        const bool other = (others[id] >> i & 1U) != 0;
        if (cell_of(triangulation.beyond(id, i)) < id) {
          EXPECT_FALSE(other);  // the facet is visited from its other cell
          continue;
        }
        ++all;
        if (other) continue;
        ++skipped;
        with_facet_certificate(
            cell.vertex, triangulation.apex_beyond(id, i), [&]<class C>(const C& certificate) {
              const KnownAtStart known = KnownAtStart::unknown;
              Failure failure;
              const auto search = [&](const auto& searches) {
                searches.first_failures(Kernel::exact, {&certificate, 1}, Instant(0), {&known, 1}, stages,
                                        TouchPolicy::ignored, {&failure, 1});
              };
              if constexpr (std::same_as<C, PowerTest<dimension>>) {
                search(*power_tests);
              } else {
                search(*orientations);
              }
              EXPECT_EQ(failure.kind, Failure::Kind::never);
            });
      }
    }
    // A facet that was forgotten at both of its cells is visited once.
    const auto [other, k] =
        std::pair(cell_of(triangulation.beyond(0, 0)), index_of(triangulation.beyond(0, 0)));
    slack.forget(0, 0);
    slack.forget(other, k);
    unsigned times = 0;
    slack.for_the_others(triangulation, [&](CellId cell, unsigned facets) {
      times += cell == 0 ? facets & 1U : 0;
      if (cell == other) {
        EXPECT_EQ(facets >> k & 1U, 0U);
      }
    });
    EXPECT_EQ(times, 1U);
  }
  EXPECT_GE(static_cast<double>(skipped), least_share * static_cast<double>(all));
  EXPECT_EQ(all > 0, least_share > 0);
}

TEST(FacetSlack, HoldWhereBeadsStrayLess) {
  expect_skipped_to_hold<3>(1e-6, 0.9);
  expect_skipped_to_hold<3>(1e-4, 0.5);
  expect_skipped_to_hold<3>(0.1, 0);  // too fast for any facet to be skipped
  expect_skipped_to_hold<2>(1e-5, 0.9);
}

}  // namespace
}  // namespace kds::facet_slack_test
