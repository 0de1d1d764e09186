#include "certificates/types/membership.h"

#include <gtest/gtest.h>

#include "tests/support/inputs/ball_motions.h"
#include "tests/support/searches.h"

namespace kds::membership_test {
namespace {

struct Answer {
  std::uint32_t type;
  int sign;
};

template <Motion M>
Answer ask(const M& motion, bool inside, int orientation) {
  std::vector<BeadId> basis;
  for (BeadId b = 0; b + 1 < motion.bead_count(); ++b) basis.push_back(b);
  return visit_membership(
      Radii::any, motion, basis, static_cast<BeadId>(basis.size()), inside, orientation,
      [&](const auto& certificate) {
        StageCounts stages;
        const int sign = test::sign_now(Kernel::exact, certificate, motion, Instant(0.5), stages);
        EXPECT_EQ((test::sign_now(Kernel::filtered, certificate, motion, Instant(0.5), stages)), sign);
        return Answer{certificate.identity().type, sign};
      });
}

template <class T>
class Memberships : public testing::Test {};

using Cases = testing::Types<test::BallCase<2, 1, 1>, test::BallCase<2, 2, 1>, test::BallCase<2, 3, 1>,
                             test::BallCase<3, 1, 1>, test::BallCase<3, 2, 1>, test::BallCase<3, 3, 1>,
                             test::BallCase<3, 4, 1>>;
TYPED_TEST_SUITE(Memberships, Cases);

TYPED_TEST(Memberships, AreJudgedByTheRightCertificate) {
  test::Random random(761);
  int judged = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("seed 761, round " + std::to_string(i));
    test::BallShape shape;
    auto motion = test::motion_of<TypeParam>(random, shape);
    const bool equal = i % 2 == 0;
    const bool odd_weights = i % 4 == 0;
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      for (int k = 0; k <= 1 && equal; ++k) {
        motion.set_radius(b, k, 0.2 + 0.1 * k);
        if (odd_weights) motion.set_weight(b, k, b);
      }
    }
    const Dyadic time(0.5);
    const int orientation = [&] {
      if constexpr (TypeParam::C::full)
        return test::certificate_at<typename TypeParam::C>(motion, time).orientation;
      return 0;
    }();
    const auto expected = test::judged_inside(motion, time);
    for (const bool inside : {true, false}) {
      const Answer answer = ask(motion, inside, orientation);
      const CertificateType& type = !equal || (TypeParam::C::full && odd_weights) ? BallInSphere<3, 4>::type
                                    : TypeParam::C::full                          ? PowerTest<3>::type
                                                                                  : BeadInSphere<1>::type;
      EXPECT_EQ(answer.type, type.number);
      if (expected) {
        EXPECT_EQ(answer.sign, inside ? *expected : -*expected);
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 50);
}

}  // namespace
}  // namespace kds::membership_test
