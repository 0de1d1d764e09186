// A facet is found positive only where its certificate, judged on integers, never fails.

#include "structures/positive_facets.h"

#include <gtest/gtest.h>

#include <set>

#include "certificates/failure_search.h"
#include "tests/support/random_motion.h"

namespace kds {
namespace {

/// On integers.
template <Motion M, class Cell>
bool holds(const M& motion, const Cell& cell) {
  decltype(PowerTest<M::dimension>::beads) beads{};
  std::copy(cell.vertex.begin(), cell.vertex.end(), beads.begin());
  beads.back() = cell.apex[0];
  StageCounts stages;
  const Failure failure =
      first_failure<Exact>(PowerTest<M::dimension>(beads, 1), motion, Instant(0), Birth::unknown, stages);
  return failure.kind == Failure::Kind::never;
}

template <Motion M>
void compare(std::uint64_t least_found) {
  constexpr int dimension = M::dimension;
  test::Random random(77);
  std::uint64_t found = 0, doubted = 0;
  for (int round = 0; round < 40; ++round) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      M motion = test::random_motion<M>(random, dimension + 2, kind);
      if (round % 2 == 0) {  // slow: some hold all the time
        for (BeadId b = 0; b < motion.bead_count(); ++b) {
          for (int axis = 0; axis < dimension; ++axis)
            motion.set_coordinate(
                b, 1, axis, motion.coordinate(b, 0, axis) * 0.99 + 0.01 * motion.coordinate(b, 1, axis));
        }
      }
      // Three facets, so that a lane stays empty: two orders of the beads, of opposite sides, and one again.
      TriangulationCell<dimension> cell;
      for (int i = 0; i <= dimension; ++i) {
        cell.vertex[static_cast<std::size_t>(i)] = static_cast<BeadId>(i);
        cell.apex[static_cast<std::size_t>(i)] = dimension + 1;
      }
      TriangulationCell<dimension> turned = cell;
      std::swap(turned.vertex[0], turned.vertex[1]);
      std::multiset<FacetId> doubts;
      const auto doubt = [&](FacetId facet) { doubts.insert(facet); };
      PositiveFacets<M> positive(motion);
      positive.look_at(cell, 1, 10, true, doubt);
      positive.look_at(turned, 1, 40, false, doubt);
      positive.look_at(turned, 0, 20, true, doubt);
      positive.look_at(cell, 2, 30, true, doubt);
      positive.finish(doubt);
      positive.finish(doubt);  // nothing is left
      EXPECT_EQ(positive.count() + doubts.size(), 3U);
      EXPECT_EQ(doubts.count(10), doubts.count(30));
      EXPECT_FALSE(doubts.contains(40));
      EXPECT_TRUE(doubts.contains(10) || holds(motion, cell));
      EXPECT_TRUE(doubts.contains(20) || holds(motion, turned));
      found += positive.count();
      doubted += doubts.size();
    }
  }
  EXPECT_GT(found, least_found);
  EXPECT_GT(doubted, 100U);
}

TEST(PositiveFacets, HoldAllOverTheStep) {
  compare<BezierMotion<3, 1>>(50);
  compare<BezierMotion<2, 1>>(50);
}

}  // namespace
}  // namespace kds
