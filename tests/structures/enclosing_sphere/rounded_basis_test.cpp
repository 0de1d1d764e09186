// Bases that are proved in doubles are equal to those that integers find.

#include <gtest/gtest.h>

#include "motions/curves/bezier_motion.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::rounded_basis_test {
namespace {

using namespace test;

template <int dimension>
void expect_proofs_are_right(bool equal_radii) {
  Random random(5);
  const Dyadic time(Integer(3), 3);
  int proved = 0, right = 0;
  for (int round = 0; round < rounds(400); ++round) {
    const MotionKind kind =
        round % 2 == 0 ? MotionKind::generic : all_motion_kinds[random() % all_motion_kinds.size()];
    auto motion = random_motion<BezierMotion<dimension, 1>>(random, 7, kind);
    for (BeadId b = 0; b < 7; ++b)
      for (int k = 0; k < 2; ++k) motion.set_radius(b, k, equal_radii ? 0.3 : uniform(random, 0, 0.5));
    const MotionRef<dimension> ref(motion);
    const IntegerBalls<dimension> whole = integer_balls_at(ref.curves(), time);
    const RoundedPositions<dimension> rounded(ref, time);
    for (int subset = 1; subset < 1 << 7; ++subset) {
      std::vector<BeadId> members;
      for (BeadId b = 0; b < 7; ++b)
        if ((subset >> b & 1) != 0) members.push_back(b);
      if (members.size() > dimension + 1) continue;
      const Basis basis(members);
      const bool is_proved = is_surely_basis_of(basis, {0, 6}, rounded);
      const auto sphere = kds::ExactSphere<dimension>::touching(whole.of(members));
      const bool is_right = sphere && sphere->is_proper() && !bead_outside(basis, BeadRange{0, 6}, whole);
      EXPECT_TRUE(is_right || !is_proved);
      if (kind != MotionKind::generic) continue;
      proved += is_proved ? 1 : 0;
      right += is_right ? 1 : 0;
    }
  }
  EXPECT_GT(right, rounds(150));
  EXPECT_EQ(proved, right);
}

TEST(RoundedBasis, IsProvedWhereItIsRight) {
  for (const bool equal_radii : {true, false}) {
    expect_proofs_are_right<2>(equal_radii);
    expect_proofs_are_right<3>(equal_radii);
  }
}

}  // namespace
}  // namespace kds::rounded_basis_test
