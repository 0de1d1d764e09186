#include "motions/views/motion_ahead.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motions/curves/bezier_motion.h"
#include "motions/numbers/exact_number.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::motion_ahead_test {
namespace {

template <int dimension>
using Step = BezierMotion<dimension, 1>;

template <int dimension>
void go_on(Step<dimension>& motion, BeadId bead, int axis, double by) {
  const double from = motion.coordinate(bead, 1, axis);
  motion.set_coordinate(bead, 0, axis, from);
  motion.set_coordinate(bead, 1, axis, from + by);
}

// Bead 0 moves straight on, bead 1 rests, bead 2 turns slightly, bead 3 jumps, bead 4 changes its weight, and
// bead 5 moves by a step that is rounded.
template <int dimension>
void expect_to_tell_who_turned() {
  Step<dimension> motion(6);
  MotionAhead<dimension> ahead;
  for (int k = 0; k < 5; ++k) {
    SCOPED_TRACE(k);
    for (int axis = 0; axis < dimension; ++axis) {
      go_on(motion, 0, axis, 0.375);
      go_on(motion, 1, axis, 0);
      go_on(motion, 2, axis, k % 2 == 0 || axis > 0 ? 1 : 1 + 0x1p-40);
      go_on(motion, 3, axis, 1);
      go_on(motion, 4, axis, 1);
      motion.set_coordinate(5, 0, axis, 1e-3 / 3);
      motion.set_coordinate(5, 1, axis, 1.0 / 3);
    }
    for (const int end : {0, 1}) motion.set_coordinate(3, end, 0, motion.coordinate(3, end, 0) + k);
    for (const int end : {0, 1}) motion.set_weight(4, end, k);
    ahead.look_at(Curves<dimension>(motion));
    for (const BeadId bead : {0U, 1U}) EXPECT_EQ(ahead.turned(bead), k == 0 ? -1 : 0);
    for (const BeadId bead : {2U, 3U, 4U}) EXPECT_EQ(ahead.turned(bead), -1) << bead;
    EXPECT_EQ(ahead.turned(no_bead), 0);
    for (const BeadId bead : {0U, 1U, 2U, 3U, 4U}) EXPECT_TRUE(ahead.is_known(bead)) << bead;
  }
  EXPECT_FALSE(ahead.is_known(5));
  EXPECT_DOUBLE_EQ(ahead.share_straight(), 2.0 / 6);
}

TEST(MotionAhead, TellsWhoTurned) {
  expect_to_tell_who_turned<2>();
  expect_to_tell_who_turned<3>();
}

TEST(MotionAhead, MoreOrFewerBeadsHaveAllTurned) {
  MotionAhead<3> ahead;
  for (const BeadId beads : {6U, 9U, 3U}) {
    const Step<3> at_rest(beads);
    for (const int turned : {-1, 0}) {
      ahead.look_at(Curves<3>(at_rest));
      for (BeadId b = 0; b < beads; ++b) EXPECT_EQ(ahead.turned(b), turned) << b << " of " << beads;
    }
  }
}

// Checks by rationals, for numbers of all sizes: the predicted position of a known bead is exact, and a bead
// that is not known is predicted to be far from all others.
TEST(MotionAhead, IsExactOrFarAway) {
  test::Random random(3);
  std::size_t known = 0, unknown = 0;
  for (int round = 0; round < 400; ++round) {
    Step<3> motion(4);
    MotionAhead<3> ahead;
    for (BeadId bead = 0; bead < 4; ++bead) {
      for (int axis = 0; axis < 3; ++axis) {
        const double from = round % 3 == 0
                                ? 1e-3 * test::uniform(random)
                                : std::ldexp(std::floor(test::uniform(random) * 4096), round % 40 - 20);
        const double step =
            round % 3 == 0 ? test::uniform(random) : std::ldexp(std::floor(test::uniform(random) * 64), -12);
        motion.set_coordinate(bead, 0, axis, from);
        motion.set_coordinate(bead, 1, axis, from + step);
      }
      if (round == 7) motion.set_coordinate(bead, 1, 0, 1e308);
    }
    ahead.look_at(Curves<3>(motion));
    for (BeadId bead = 0; bead < 4; ++bead) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(ahead.coordinate(bead, 0, axis), motion.coordinate(bead, 0, axis));
        const Rational from = motion.coordinate(bead, 0, axis), to = motion.coordinate(bead, 1, axis);
        if (ahead.is_known(bead)) {
          ASSERT_EQ(Rational(ahead.coordinate(bead, 1, axis)), from + MotionAhead<3>::steps * (to - from));
        }
      }
      if (!ahead.is_known(bead)) {
        for (BeadId other = 0; other < bead; ++other)
          ASSERT_GE(std::abs(ahead.coordinate(bead, 1, 0) - ahead.coordinate(other, 1, 0)), 0x1p959);
      }
      ++(ahead.is_known(bead) ? known : unknown);
    }
  }
  EXPECT_GT(known, 200U);
  EXPECT_GT(unknown, 200U);
}

// Beads that were not examined in the step before count as turned.
TEST(MotionAhead, LooksAtSomeAlone) {
  Step<3> motion(100);
  MotionAhead<3> ahead;
  for (int k = 0; k < 3; ++k) {
    for (BeadId bead = 0; bead < 100; ++bead) go_on(motion, bead, 0, 0.5);
    ahead.look_at_some(Curves<3>(motion));
    EXPECT_EQ(ahead.share_straight(), k == 0 ? 0 : 1);
  }
  for (BeadId bead = 0; bead < 100; ++bead) go_on(motion, bead, 0, 0.5);
  ahead.look_at(Curves<3>(motion));
  EXPECT_EQ(ahead.share_straight(), 0);
  for (BeadId bead = 0; bead < 100; ++bead) go_on(motion, bead, 0, 0.5);
  ahead.look_at(Curves<3>(motion));
  EXPECT_EQ(ahead.share_straight(), 1);
}

}  // namespace
}  // namespace kds::motion_ahead_test
