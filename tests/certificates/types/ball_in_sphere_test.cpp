#include "certificates/types/ball_in_sphere.h"

#include <gtest/gtest.h>

#include "certificates/search/define_radical_search.h"
#include "tests/support/inputs/ball_motions.h"
#include "tests/support/searches.h"

namespace kds::ball_in_sphere_test {
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
    if (i % 5 == 0) shape.largest_radius = 2.5;  // often a vanishes, or balls contain each other
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
      EXPECT_EQ((test::sign_now(Kernel::exact, certificate, motion, Instant(u), stages)), sign);
      EXPECT_EQ((test::sign_now(Kernel::filtered, certificate, motion, Instant(u), stages)), sign);
      if (sign != 0) {
        EXPECT_EQ((test::sign_just_after(Kernel::exact, certificate, motion, Instant(u), stages)), sign);
        EXPECT_EQ((test::sign_just_after(Kernel::filtered, certificate, motion, Instant(u), stages)), sign);
      }
    }
  }
  EXPECT_GT(proper, 100);
  EXPECT_GT(seen[0], 5);
  EXPECT_GT(seen[2], TypeParam::size == 1 ? 1 : 5);
}

// A ball leaves the sphere of two balls, and 2e-15 later one of the two gets inside the other. Signs after
// that time say nothing about the failure.
TEST(BallInSphere, FailsJustBeforeItGoesOutOfUse) {
  constexpr double z[2] = {-0.81240614211668882, -0.81208716991119012};
  constexpr double xy[3][2][2] = {
      {{-0.33345544734054555, -0.71349104094865523}, {-0.33309810510090621, -0.71308397138777047}},
      {{-0.34006824645984091, -0.70853142984946405}, {-0.3396382983828492, -0.7081788146665936}},
      {{-0.33345543166091934, -0.71349104094865523}, {-0.33309808942128005, -0.71308397138777047}}};
  constexpr double radius[3] = {0.016441279700628308, 0.0082206241706954501, 0.016441264021002128};
  BezierMotion<3, 1> motion(3);
  for (BeadId b = 0; b < 3; ++b) {
    for (int k = 0; k < 2; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, k, axis, axis == 2 ? z[k] : xy[b][k][axis]);
      motion.set_radius(b, k, radius[b]);
    }
  }
  const BallInSphere<3, 2> certificate{{0, 1, 2}, true, 1};
  StageCounts stages;
  const Failure exact =
      test::first_failure(Kernel::exact, certificate, motion, Instant(0), KnownAtStart::unknown, stages);
  const Failure filtered =
      test::first_failure(Kernel::filtered, certificate, motion, Instant(0), KnownAtStart::unknown, stages);
  ASSERT_EQ(exact.kind, Failure::Kind::later);
  ASSERT_EQ(filtered.kind, Failure::Kind::later);
  EXPECT_LT(exact.time.lower, 0.49968902421347866);
  EXPECT_LE(filtered.time.lower, exact.time.upper);
  EXPECT_GE(filtered.time.upper, exact.time.lower);
  const double after = 0.49968902421425;  // at this time the order of the two failures is uncertain in double
  const Curves<3> curves(motion);
  const auto usable = [&](double from, double to) {
    return detail::CertificateInDouble<BallInSphere<3, 2>, Curves<3>>(detail::Errors::own_filter, certificate,
                                                                      curves)
        .is_usable_on(from, to);
  };
  EXPECT_TRUE(usable(0.3, 0.3001));
  EXPECT_FALSE(usable(exact.time.lower, after));
}

}  // namespace
}  // namespace kds::ball_in_sphere_test
