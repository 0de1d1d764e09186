#include "certificates/search/snapshot_sign.h"

#include <gtest/gtest.h>

#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"

namespace kds::snapshot_sign_test {
namespace {

template <int Dimension, class Certificate>
void signs_agree(std::array<BeadId, Certificate::size> beads) {
  using M = BezierMotion<Dimension, 1>;
  test::Random random(404);
  std::array<int, 3> seen{};
  int generic = 0, missed = 0;
  for (int round = 0; round < 60; ++round) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const M motion = test::random_motion<M>(random, 5, kind);
      for (const int k : {0, 1}) {
        Snapshot<Dimension> placement;
        placement.set(motion, k);
        const int sign = snapshot_sign(Certificate(beads, 1), placement);
        ASSERT_EQ(sign, test::sign_at(Certificate(beads, 1), motion, Dyadic(k))) << static_cast<int>(kind);
        ++seen[static_cast<std::size_t>(sign + 1)];
        // The vectorized code evaluates the formula in the order of the beads in each lane. A sign reported
        // as positive must be positive.
        std::array<std::array<BeadId, Certificate::size>, Lanes::width> tuples;
        tuples.fill(beads);
        std::swap(tuples[1][0], tuples[1][1]);
        std::swap(tuples[3][1], tuples[3][2]);
        Lanes::Mask positive;
        snapshot_positive<Certificate>(placement, tuples, Lanes(1.0), positive);
        for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
          const bool is_positive = sign == (lane % 2 == 0 ? 1 : -1);
          EXPECT_TRUE(is_positive || positive[lane] == 0);
          if (!is_positive || kind != test::MotionKind::generic) continue;
          ++generic;
          missed += positive[lane] != 0 ? 0 : 1;  // missed if a weight is larger than a squared length
        }
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 20);
  EXPECT_GT(generic, 100);
  EXPECT_LT(10 * missed, generic);
}

TEST(Placed, SignsAreThoseOfTheExactPosition) {
  signs_agree<3, PowerTest<3>>({0, 1, 2, 3, 4});
  signs_agree<3, Orientation<3>>({0, 1, 2, 3});
  signs_agree<2, PowerTest<2>>({0, 1, 2, 3});
  signs_agree<2, Orientation<2>>({0, 1, 2});
}

TEST(Placed, CentersAndWeightsAsGiven) {
  const Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Random(3, 4);
  const std::vector<double> weights{1, 2, 3, 4};
  const Snapshot<3> placement(centers, weights);
  ASSERT_EQ(placement.bead_count(), 4U);
  for (BeadId b = 0; b < 4; ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(placement.coordinate(b, 0, axis), centers(axis, b));
      EXPECT_EQ(placement.control_point(b, 0)[axis], centers(axis, b));
    }
    EXPECT_EQ(placement.weight(b, 0), weights[b]);
    EXPECT_EQ(placement.control_point(b, 0)[3], weights[b]);
  }
}

}  // namespace
}  // namespace kds::snapshot_sign_test
