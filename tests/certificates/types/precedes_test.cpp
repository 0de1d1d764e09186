#include "certificates/types/precedes.h"

#include <gtest/gtest.h>

#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/searches.h"

namespace kds::precedes_test {
namespace {

TEST(Precedes, IsTheOrderAlongTheFirstAxis) {
  test::Random random(731);
  for (int i = 0; i < 100; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<BezierMotion<2, 3>>(random, 2, kind);
      const Dyadic time = test::random_dyadic(random);
      const test::second::Rational left = test::point_at(motion, 0, time)[0];
      const test::second::Rational right = test::point_at(motion, 1, time)[0];
      EXPECT_EQ(test::sign_at(Precedes{{0, 1}}, motion, time), test::sign(right - left));
      EXPECT_EQ(test::sign_at(Precedes{{1, 0}}, motion, time), test::sign(left - right));
    }
  }
}

TEST(Precedes, AlongEachAxis) {
  test::Random random(732);
  for (const test::MotionKind kind : test::all_motion_kinds) {
    const auto motion = test::random_motion<BezierMotion<3, 3>>(random, 2, kind);
    const Dyadic time = test::random_dyadic(random);
    const auto left = test::point_at(motion, 0, time), right = test::point_at(motion, 1, time);
    EXPECT_EQ(test::sign_at(PrecedesAlong<0>{{0, 1}}, motion, time), test::sign(right[0] - left[0]));
    EXPECT_EQ(test::sign_at(PrecedesAlong<1>{{0, 1}}, motion, time), test::sign(right[1] - left[1]));
    EXPECT_EQ(test::sign_at(PrecedesAlong<2>{{1, 0}}, motion, time), test::sign(left[2] - right[2]));
  }
  EXPECT_NE((PrecedesAlong<1>{{0, 1}}.identity()), (Precedes{{0, 1}}.identity()));
  EXPECT_NE((PrecedesAlong<1>{{0, 1}}.identity()), (PrecedesAlong<2>{{0, 1}}.identity()));
}

TEST(Precedes, HasOneIdentityBothWays) {
  EXPECT_EQ((Precedes{{5, 2}}.identity()), (Precedes{{2, 5}}.identity()));
  EXPECT_EQ((Precedes{{5, 2}}.identity().beads), test::identity_with(0, {2, 5}).beads);
  EXPECT_EQ((Precedes{{5, 2}}.identity().type), Precedes::type.number);
}

// Simultaneous failures are handled in the order of their types.
TEST(Identity, OrdersTypesFirst) {
  const auto of = [](const CertificateType& type, BeadId bead) {
    return identity_of(type, std::array{bead});
  };
  EXPECT_LT(of(Precedes::type, 9), of(Orientation<3>::type, 1));
  EXPECT_LT(of(Orientation<3>::type, 9), of(PowerTest<3>::type, 1));
  EXPECT_LT(of(PowerTest<3>::type, 9), of(BeadInSphere<1>::type, 1));
  EXPECT_LT(of(PowerTest<3>::type, 1), of(PowerTest<3>::type, 2));
}

}  // namespace
}  // namespace kds::precedes_test
