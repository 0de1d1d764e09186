#include "certificates/filters/slack.h"

#include <gtest/gtest.h>

#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/distances.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/rounds.h"

namespace kds::slack_test {
namespace {

using test::Random;
using test::uniform;

template <class S>
class Tolerances : public testing::Test {
 protected:
  static constexpr std::size_t beads = bead_arity<S>;
  using M = BezierMotion<3, 1>;

  static S certificate() {
    S c{};
    for (std::size_t p = 0; p < beads; ++p) c.beads[p] = static_cast<BeadId>(p);
    return c;
  }
  static double slack(const M& motion, double side) {
    typename LanesView<M, beads, channels_of<S>>::Tuples tuples;
    tuples.fill(certificate().beads);
    Lanes result;
    slack_lanes<S>(motion, tuples, Lanes(side), result);
    for (std::size_t lane = 1; lane < Lanes::width; ++lane) EXPECT_EQ(result.v[lane], result.v[0]);
    return result.v[0];
  }
  // Returns the exact sign of the formula after every bead has moved by at most half of `wander` in each
  // coordinate, so that no difference changes by more than `wander`.
  static int sign_after_wandering(M motion, double wander, bool to_the_corners, Random& random) {
    for (BeadId b = 0; b < beads; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        const double by = to_the_corners ? (random() % 2 ? 0.5 : -0.5) : uniform(random, -0.5, 0.5);
        const double to = motion.coordinate(b, 0, axis) + by * wander;
        motion.set_coordinate(b, 0, axis, to);
      }
    }
    return test::sign_at(certificate(), motion, Dyadic(0.0));
  }
};

using Subjects = testing::Types<PowerTest<3>, BeadInSphere<2>, BeadInSphere<3>, Orientation<3>, Contact>;
TYPED_TEST_SUITE(Tolerances, Subjects);

TYPED_TEST(Tolerances, NoSignChangesWithinIt) {
  Random random(20);
  int positive = 0, changed_soon_beyond = 0;
  for (int round = 0; round < test::rounds(400); ++round) {
    const auto kind = test::all_motion_kinds[static_cast<std::size_t>(round) % test::all_motion_kinds.size()];
    auto motion = test::random_motion<BezierMotion<3, 1>>(random, TestFixture::beads, kind);
    if (round % 5 == 4) test::scale(motion, test::pick(random, -1, 1) * 100);
    const int sign = test::sign_at(TestFixture::certificate(), motion, Dyadic(0.0));
    if (sign == 0) {
      EXPECT_EQ(TestFixture::slack(motion, 1), 0);
      EXPECT_EQ(TestFixture::slack(motion, -1), 0);
      continue;
    }
    EXPECT_EQ(TestFixture::slack(motion, -sign), 0);
    const double slack = TestFixture::slack(motion, sign);
    if (slack == 0) continue;  // far from the range of doubles the filter gives no slack
    ++positive;
    // The factor ensures that rounding does not move coordinates beyond the slack.
    for (int i = 0; i < 40; ++i)
      EXPECT_EQ(TestFixture::sign_after_wandering(motion, slack * (1 - 0x1p-20), i % 2 == 0, random), sign);
    bool changed = false;
    for (int i = 0; i < 40; ++i)
      changed |= TestFixture::sign_after_wandering(motion, 20 * slack, i % 2 == 0, random) != sign;
    changed_soon_beyond += changed ? 1 : 0;
  }
  EXPECT_GT(positive, test::rounds(100));
  EXPECT_GT(changed_soon_beyond, positive / 20);  // the slack is not unnecessarily small
}

TEST(Tolerance, IsTheDistanceToContactNearly) {
  // Two balls of radius 1 are 4 apart along an axis. The difference may shrink by 2, but the bound is limited
  // to a sixteenth of the distance. At distance 2.1 almost all of the 0.1 is slack.
  BezierMotion<3, 1> motion(2);
  for (int k = 0; k <= 1; ++k) {
    for (BeadId b = 0; b < 2; ++b) motion.set_radius(b, k, 1);
    motion.set_coordinate(1, k, 0, 4);
  }
  const auto slack = [&] {
    Lanes result;
    LanesView<BezierMotion<3, 1>, 2, channels_of<Contact>>::Tuples tuples;
    tuples.fill({0, 1});
    slack_lanes<Contact>(motion, tuples, Lanes(1.0), result);
    return result.v[0];
  };
  EXPECT_NEAR(slack(), 0.25, 1e-6);
  for (int k = 0; k <= 1; ++k) motion.set_coordinate(1, k, 0, 2.1);
  EXPECT_GT(slack(), 0.08);
  EXPECT_LT(slack(), 0.1);
}

}  // namespace
}  // namespace kds::slack_test
