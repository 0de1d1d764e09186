#include "structures/enclosing_sphere/enclosing_sphere.h"

#include <gmock/gmock.h>

#include "tests/support/inputs/ball_sets.h"

namespace kds::enclosing_sphere_test {
namespace {

using namespace test;

std::vector<std::size_t> places(const Basis& basis) { return {basis.begin(), basis.end()}; }

template <class D>
class SmallestSphereIn : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SmallestSphereIn, Dimensions);

TYPED_TEST(SmallestSphereIn, OfHardSetsIsTheSmallestWithNoBallToSpare) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(71 + d);
  std::size_t by_double = 0;
  for (int round = 0; round < 60; ++round) {
    for (std::size_t which = 0; which < hard_ball_sets; ++which) {
      const auto beads = static_cast<Eigen::Index>(1 + random() % (round % 4 == 0 ? 20 : 7));
      const BallSet set = hard_ball_set(random, which, beads, round % 2 == 0, d == 2);
      const Balls<d> balls(set.centers, set.radii);
      const auto last = static_cast<BeadId>(beads - 1);
      const SmallestSphere found = smallest_sphere(balls, 0, last);
      by_double += found.took_exact ? 0 : 1;
      ASSERT_EQ(not_smallest_ball(set, 0, last, places(found.basis), found.sphere.radius), std::nullopt)
          << set.name << ", round " << round;
      // The slow reference finds the same sphere; its basis may differ.
      const SmallestSphere twin = smallest_sphere(balls, 0, last, {}, ExactUse::everywhere);
      ASSERT_EQ(not_smallest_ball(set, 0, last, places(twin.basis), found.sphere.radius), std::nullopt)
          << set.name << ", round " << round;
      // Starts from any guess.
      std::vector<BeadId> guess;
      for (unsigned i = 0; i < 1 + random() % 6; ++i)
        guess.push_back(static_cast<BeadId>(random() % (last + 1)));
      const SmallestSphere guessed = smallest_sphere(balls, 0, last, guess);
      ASSERT_EQ(not_smallest_ball(set, 0, last, places(guessed.basis), guessed.sphere.radius), std::nullopt)
          << set.name << ", round " << round;
    }
  }
  EXPECT_GT(by_double, 100U);
}

TYPED_TEST(SmallestSphereIn, DoubleSettlesWhatIsNotDegenerate) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const BallSet set = hard_ball_set(random, 0, 3 + round, round % 2 == 0, d == 2);
    const Balls<d> balls(set.centers, set.radii);
    const SmallestSphere found = smallest_sphere(balls, 0, static_cast<BeadId>(2 + round));
    EXPECT_FALSE(found.took_exact) << round;
    EXPECT_EQ(not_smallest_ball(set, 0, 2U + static_cast<std::size_t>(round), places(found.basis),
                                found.sphere.radius),
              std::nullopt);
  }
}

TEST(SmallestSphere, OfACubeHasTwoOppositeCorners) {
  Eigen::Matrix3Xd corners(3, 8);
  for (int i = 0; i < 8; ++i) corners.col(i) << (i & 1), (i >> 1 & 1), (i >> 2);
  const SmallestSphere found = smallest_sphere(Balls<3>(corners, std::vector<double>(8, 0.5)), 0, 7);
  EXPECT_EQ(found.basis.size, 2);
  EXPECT_NEAR(found.sphere.radius, std::sqrt(3) / 2 + 0.5, 1e-15);
}

TEST(Balls, RefuseWhatIsNoNumberAndNameTheBead) {
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, 3);
  centers(1, 2) = std::nan("");
  EXPECT_THAT([&] { Balls<3>(centers, std::vector<double>(3, 1.0)); },
              testing::ThrowsMessage<InputError>("bead 2: expected finite coordinates"));
  centers(1, 2) = 0;
  const std::vector<double> radii{1, -1, 1};
  EXPECT_THAT([&] { Balls<3>(centers, radii); },
              testing::ThrowsMessage<InputError>("bead 1: expected a finite radius, not negative"));
  EXPECT_THROW(Balls<3>(centers, std::vector<double>(2, 1.0)), InputError);
}

}  // namespace
}  // namespace kds::enclosing_sphere_test
