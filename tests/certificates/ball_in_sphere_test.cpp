#include "certificates/ball_in_sphere.h"

#include <gtest/gtest.h>

#include "certificates/radical_search.h"
#include "tests/support/ball_motions.h"

namespace kds {
namespace {

using test::BallShape;
using test::Random;

template <class T>
class BallInSpheres : public testing::Test {};

using Cases = testing::Types<test::BallCase<2, 1, 1>, test::BallCase<2, 2, 1>, test::BallCase<2, 3, 1>,
                             test::BallCase<3, 1, 2>, test::BallCase<3, 2, 1>, test::BallCase<3, 3, 1>,
                             test::BallCase<3, 4, 1>, test::BallCase<3, 2, 3>, test::BallCase<2, 3, 2>>;
TYPED_TEST_SUITE(BallInSpheres, Cases);

TYPED_TEST(BallInSpheres, HoldWhatTheSphereThroughTheBasisHolds) {
  using C = typename TypeParam::C;
  Random random(741);
  int proper = 0;
  std::array<int, 3> seen{};
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("seed 741, round " + std::to_string(i));
    BallShape shape;
    shape.whole = i % 3 == 0;
    if (i % 5 == 0) shape.largest_radius = 2.5;  // a tends to vanish, balls to hold each other
    if (i % 7 == 0) shape.largest_radius = 0;
    const auto motion = test::motion_of<TypeParam>(random, shape);
    const Dyadic time = test::random_dyadic(random);
    const auto expected = test::judged_inside(motion, time);
    if (!expected) continue;
    ++proper;
    ++seen[static_cast<std::size_t>(*expected + 1)];
    const double u = time.round_down();
    if (!(Dyadic(u) == time)) continue;
    for (const bool inside : {true, false}) {
      const C certificate = test::certificate_at<C>(motion, time, inside);
      StageCounts stages;
      const int sign = inside ? *expected : -*expected;
      EXPECT_EQ((sign_now<Exact>(certificate, motion, Instant(u), stages)), sign);
      EXPECT_EQ((sign_now<Filtered>(certificate, motion, Instant(u), stages)), sign);
      if (sign != 0) {
        EXPECT_EQ((sign_just_after<Exact>(certificate, motion, Instant(u), stages)), sign);
        EXPECT_EQ((sign_just_after<Filtered>(certificate, motion, Instant(u), stages)), sign);
      }
    }
  }
  EXPECT_GT(proper, 100);
  EXPECT_GT(seen[0], 5);
  EXPECT_GT(seen[2], TypeParam::size == 1 ? 1 : 5);
}

}  // namespace
}  // namespace kds
