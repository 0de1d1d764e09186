// Compares distance queries with exact decisions for all pairs.

#include "structures/collision/distance_queries.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "structures/collision/auto_detector.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/cell_list.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/rounds.h"

namespace kds::distance_queries_test {
namespace {

using namespace test;

void expect_same(const std::optional<ClosestPair>& found, const std::optional<ClosestPair>& expected) {
  ASSERT_EQ(found.has_value(), expected.has_value());
  if (!found) return;
  EXPECT_EQ(found->first, expected->first);
  EXPECT_EQ(found->second, expected->second);
  EXPECT_EQ(found->sign, expected->sign);
  EXPECT_EQ(found->distance, expected->distance);
}

template <int Dimension>
void expect_right(DistanceQueries<Dimension>& queries, const PairsAsked& asked,
                  const Balls<Dimension>& balls) {
  const auto closest = closest_pair_by_force(balls, asked);
  expect_same(queries.closest_pair(balls), closest);
  CellList<Dimension> cells(asked);
  double near = closest ? std::max(0.0, closest->distance) : 1;
  if (!(near < 1e300)) near = 1e300;
  for (const double distance : {0.0, near, 1.7 * near, balls.radius(0)}) {
    const auto expected = pairs_by_force(balls, asked, distance);
    EXPECT_EQ(queries.pairs_within(balls, distance), expected) << "within " << distance;
    EXPECT_EQ(cells.pairs_within(balls, distance), expected) << "cell list, within " << distance;
  }
}

template <int Dimension>
void expect_right_in_motion(const CollisionScene& scene, Random& random) {
  DistanceQueries<Dimension> queries(scene.asked);
  Balls<Dimension> balls(scene.centers, scene.radii);
  Eigen::Matrix3Xd centers = scene.centers;
  const double size = std::min(scene.centers.cwiseAbs().maxCoeff(), 1e306);  // sums stay finite
  // The closest pair of one frame may be the farthest pair of the next.
  for (const double step : {0.0, 1e-3 * size, size}) {
    for (Eigen::Index b = 0; step > 0 && b < centers.cols(); ++b)
      for (Eigen::Index axis = 0; axis < 3; ++axis) centers(axis, b) += uniform(random, -step, step);
    balls.move_to(centers);
    expect_right(queries, scene.asked, balls);
  }
}

TEST(DistanceQueries, RandomScenesOfAllSizesAndPlaces) {
  for (unsigned seed = 0; seed < rounds(16U); ++seed) {
    Random random(seed);
    const CollisionScene scene = random_scene(random, 40);
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_right_in_motion<3>(scene, random);
    expect_right_in_motion<2>(scene, random);
    if (HasFailure()) return;
  }
}

TEST(DistanceQueries, NoBeadsOneBeadTwoBeads) {
  const Balls<3> nothing(Eigen::Matrix3Xd(3, 0), {});
  EXPECT_FALSE(DistanceQueries<3>({}).closest_pair(nothing));
  EXPECT_TRUE(DistanceQueries<3>({}).pairs_within(nothing, 1).empty());
  const Balls<3> one(Eigen::Matrix3Xd::Zero(3, 1), std::vector{1.0});
  EXPECT_FALSE(DistanceQueries<3>({{{0, 0}}}).closest_pair(one));
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, 2);
  for (const double x : {0.0, 1e-300, 2.0, 1e300, std::numeric_limits<double>::max()}) {
    centers(0, 1) = x;
    for (const double radius : {0.0, 1.0, 1e300}) {
      const Balls<3> two(centers, std::vector<double>(2, radius));
      const PairsAsked asked{{{0, 0}, {1, 1}}};
      DistanceQueries<3> queries(asked);
      SCOPED_TRACE(std::to_string(x) + " apart, radius " + std::to_string(radius));
      expect_right(queries, asked, two);
      EXPECT_FALSE(DistanceQueries<3>({{{0, 0}, {1, 1}}, true, 1, false}).closest_pair(two));
    }
  }
}

// Beads coincide in heaps, so all pairs of adjacent heaps have equal distances.
TEST(DistanceQueries, MorePairsEquallyFarApartThanAreListed) {
  constexpr BeadId heap = 40, heaps = 30, beads = heap * heaps;
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, beads);
  for (BeadId b = 0; b < beads; ++b) centers(0, Eigen::Index{b}) = b / heap;
  const PairsAsked asked{{{0, beads - 1}}, true, heap, true};
  const Balls<3> balls(centers, std::vector<double>(beads, 0.0));
  DistanceQueries<3> queries(asked);
  expect_same(queries.closest_pair(balls), closest_pair_by_force(balls, asked));
}

TEST(DistanceQueries, BesideKeptPairs) {
  Random random(7);
  CollisionScene scene = random_scene(random, 300);
  scene.radii.assign(scene.radii.size(), 0.01);
  AutoDetector<3> detector(scene.asked);
  for (int frame = 0; frame < 20; ++frame) {
    scene.centers.array() += 1e-6;
    const Balls<3> balls(scene.centers, scene.radii);
    EXPECT_EQ(detector.pairs(balls), pairs_by_force(balls, scene.asked));
    expect_same(detector.closest_pair(balls), closest_pair_by_force(balls, scene.asked));
  }
}

}  // namespace
}  // namespace kds::distance_queries_test
