#include "certificates/types/precedes.h"

#include <gtest/gtest.h>

#include "tests/support/random_motion.h"
#include "tests/support/rational_geometry.h"

namespace kds {
namespace {

TEST(Precedes, IsTheOrderAlongTheFirstAxis) {
  test::Random random(731);
  for (int i = 0; i < 100; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<BezierMotion<2, 3>>(random, 2, kind);
      const Dyadic time = test::random_dyadic(random);
      const Rational left = test::point_at(motion, 0, time)[0];
      const Rational right = test::point_at(motion, 1, time)[0];
      EXPECT_EQ(test::sign_at(Precedes{{0, 1}}, motion, time), test::sign(right - left));
      EXPECT_EQ(test::sign_at(Precedes{{1, 0}}, motion, time), test::sign(left - right));
    }
  }
}

TEST(Precedes, HasOneIdentityBothWays) {
  EXPECT_EQ((Precedes{{5, 2}}.identity()), (Precedes{{2, 5}}.identity()));
  EXPECT_EQ((Precedes{{5, 2}}.identity().beads), (std::array<BeadId, 5>{2, 5, no_bead, no_bead, no_bead}));
  EXPECT_EQ((Precedes{{5, 2}}.identity().type), static_cast<std::uint32_t>(CertificateType::precedes));
}

// Simultaneous failures are handled in the order of types.
TEST(Identity, OrdersTypesFirst) {
  const auto of = [](CertificateType type, BeadId bead) {
    return Identity{static_cast<std::uint32_t>(type), {bead, no_bead, no_bead, no_bead, no_bead}};
  };
  EXPECT_LT(of(CertificateType::precedes, 9), of(CertificateType::orientation, 1));
  EXPECT_LT(of(CertificateType::orientation, 9), of(CertificateType::power_test, 1));
  EXPECT_LT(of(CertificateType::power_test, 9), of(CertificateType::bead_in_sphere, 1));
  EXPECT_LT(of(CertificateType::power_test, 1), of(CertificateType::power_test, 2));
}

}  // namespace
}  // namespace kds
