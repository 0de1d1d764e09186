// A facet is found positive only where its certificate, judged on integers, never fails; and every facet is
// looked at once.

#include "structures/positive_facets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "certificates/failure_search.h"
#include "motions/lifted_motion.h"
#include "tests/support/random_motion.h"

namespace kds {
namespace {

/// On integers.
template <Motion M>
bool holds(const M& motion, const TriangulationCell<M::dimension>& cell, int facet) {
  decltype(PowerTest<M::dimension>::beads) beads{};
  std::copy(cell.vertex.begin(), cell.vertex.end(), beads.begin());
  beads.back() = cell.apex[static_cast<std::size_t>(facet)];
  StageCounts stages;
  const Failure failure =
      first_failure<Exact>(PowerTest<M::dimension>(beads, 1), motion, Instant(0), Birth::unknown, stages);
  return failure.kind == Failure::Kind::never;
}

/// A cell of the first beads, another beyond each facet, and the same turned over.
template <int dimension>
std::array<TriangulationCell<dimension>, 2> cell_both_ways() {
  TriangulationCell<dimension> cell;
  for (BeadId i = 0; i <= dimension; ++i) {
    cell.vertex[i] = i;
    cell.apex[i] = dimension + 1 + i;
  }
  TriangulationCell<dimension> turned = cell;
  std::swap(turned.vertex[0], turned.vertex[1]);
  return {cell, turned};
}

/// Looks at all facets of some cells, and judges them.
template <Motion M>
void expect_right(const M& motion, std::span<const TriangulationCell<M::dimension>> cells,
                  std::uint64_t& found) {
  std::set<FacetId> doubts;
  const auto doubt = [&](FacetId facet) { EXPECT_TRUE(doubts.insert(facet).second); };
  PositiveFacets<M> positive(motion);
  for (CellId id = 0; id < cells.size(); ++id)
    positive.look_at(cells[id], id, all_facets<M::dimension>, doubt);
  positive.finish(doubt);
  positive.finish(doubt);  // nothing is left
  EXPECT_EQ(positive.count() + doubts.size(), cells.size() * (M::dimension + 1));
  for (CellId id = 0; id < cells.size(); ++id) {
    for (int i = 0; i <= M::dimension; ++i)
      EXPECT_TRUE(doubts.contains(facet_id(id, i)) || holds(motion, cells[id], i)) << id << ' ' << i;
  }
  found += positive.count();
}

template <Motion M>
void slow_down(M& motion) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 1; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis)
        motion.set_coordinate(b, k, axis,
                              motion.coordinate(b, 0, axis) * 0.99 + 0.01 * motion.coordinate(b, k, axis));
    }
  }
}

template <Motion M>
void compare(std::uint64_t least_found) {
  test::Random random(77);
  std::uint64_t found = 0;
  for (int round = 0; round < 30; ++round) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      M motion = test::random_motion<M>(random, 2 * (M::dimension + 1), kind);
      if (round % 2 == 0) slow_down(motion);  // then some hold all the time
      const auto cells = cell_both_ways<M::dimension>();
      expect_right<M>(motion, cells, found);
    }
  }
  EXPECT_GT(found, least_found);
}

TEST(PositiveFacets, HoldAllOverTheStep) {
  compare<BezierMotion<3, 1>>(200);
  compare<BezierMotion<2, 1>>(200);
  compare<BezierMotion<3, 3>>(100);
  compare<LiftedMotion<3>>(100);
  compare<LiftedMotion<2>>(100);
}

// Corners of a cube and its mirror image, moved by less and less: where floats round away what decides.
TEST(PositiveFacets, HoldNextToZero) {
  using M = BezierMotion<3, 1>;
  test::Random random(5);
  std::uint64_t found = 0;
  for (int places = 4; places < 45; ++places) {
    for (int round = 0; round < 100; ++round) {
      M motion(8);
      for (BeadId b = 0; b < 8; ++b) {
        for (int axis = 0; axis < 3; ++axis) {
          const double corner = (b >> axis & 1U) != 0 ? 1 : -1;
          for (int k = 0; k < 2; ++k)
            motion.set_coordinate(b, k, axis, corner + std::ldexp(test::uniform(random), -places));
        }
      }
      auto cells = cell_both_ways<3>();
      for (auto& cell : cells) {
        std::swap(cell.vertex[3], cell.apex[0]);  // corners 0, 1, 2, 4: not in one plane
      }
      expect_right<M>(motion, cells, found);
    }
  }
  EXPECT_GT(found, 1000U);
}

// Far from where the bound is claimed nothing is found; near its ends what is found is right.
TEST(PositiveFacets, HoldAtAnyScale) {
  using M = BezierMotion<3, 1>;
  test::Random random(6);
  for (int exponent = -320; exponent <= 320; exponent += 4) {
    std::uint64_t found = 0;
    for (int round = 0; round < 4; ++round) {
      M motion = test::random_motion<M>(random, 8, test::MotionKind::generic);
      slow_down(motion);
      for (BeadId b = 0; b < 8; ++b) {
        for (int k = 0; k < 2; ++k) {
          for (int axis = 0; axis < 3; ++axis)
            motion.set_coordinate(b, k, axis, std::ldexp(motion.coordinate(b, k, axis), exponent));
          motion.set_weight(b, k, std::ldexp(motion.weight(b, k), 2 * exponent));
        }
      }
      const auto cells = cell_both_ways<3>();
      expect_right<M>(motion, cells, found);
    }
    if (std::abs(exponent) <= 8) {
      EXPECT_GT(found, 0U) << exponent;
    }
    if (std::abs(exponent) >= 20) {
      EXPECT_EQ(found, 0U) << exponent;
    }
  }
}

template <int dimension>
void expect_each_once() {
  test::Random random(7);
  Eigen::Matrix3Xd centers(3, 200);
  for (auto& x : centers.reshaped()) x = test::uniform(random);
  RegularTriangulation<dimension> triangulation;
  static_cast<void>(triangulation.build(centers, std::vector<double>(200, 0.0)));
  const auto cells = triangulation.cells();
  FacetCover cover(cells.size());
  std::map<FacetId, int> times;
  std::size_t left_out = 0;
  for (CellId id = 0; id < cells.size(); ++id) {
    const unsigned finite = finite_facets(cells[id]);
    const unsigned facets = cover.facets_of(cells[id], id, finite == all_facets<dimension>);
    left_out += facets == 0 ? 1 : 0;
    EXPECT_EQ(finite == 0, std::find(cells[id].vertex.begin(), cells[id].vertex.end(), infinite_bead) !=
                               cells[id].vertex.end());
    for (int i = 0; i <= dimension; ++i) {
      const FacetId here = facet_id(id, i);
      EXPECT_EQ(finite == 0 || (finite >> i & 1U) != 0,
                finite == 0 || triangulation.apex_beyond(id, i) != infinite_bead);
      if ((facets >> i & 1U) != 0) ++times[std::min(here, triangulation.beyond(id, i))];
    }
  }
  EXPECT_EQ(times.size(), cells.size() * (dimension + 1) / 2);
  for (const auto& [facet, count] : times) EXPECT_EQ(count, 1) << facet;
  EXPECT_GT(4 * left_out, cells.size());
}

TEST(FacetCover, HasEachFacetOnce) {
  expect_each_once<3>();
  expect_each_once<2>();
}

}  // namespace
}  // namespace kds
