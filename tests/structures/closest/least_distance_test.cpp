// Checks the enclosure of the least distance of two beads in a step over rationals. At sampled times no
// distance is below the enclosure, and at the reported time the distance is not above it. In linear motion
// the enclosure contains the exact least distance.

#include "structures/closest/least_distance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "motions/curves/positions.h"
#include "motions/numbers/exact_number.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::least_distance_test {
namespace {

using namespace test;

template <class M>
Rational square_of_distance(const M& motion, const Dyadic& time) {
  const auto a = exact_position(motion, 0, time), b = exact_position(motion, 1, time);
  Rational square = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(M::dimension); ++axis)
    square += (b[axis] - a[axis]) * (b[axis] - a[axis]);
  return square;
}

Rational square_of(double x) { return Rational(x) * Rational(x); }

template <class M>
M random_motion(Random& random, double scale) {
  M motion(2);
  for (BeadId b = 0; b < 2; ++b)
    for (int k = 0; k <= M::degree; ++k)
      for (int axis = 0; axis < M::dimension; ++axis)
        motion.set_coordinate(b, k, axis, scale * 0x1p-16 * pick(random, -(1 << 17), 1 << 17));
  return motion;
}

template <class M>
void expect_enclosed(const M& motion) {
  const LeastDistance least = least_distance(Curves<M::dimension>(motion), 0, 1);
  ASSERT_TRUE(0 <= least.lower && least.lower <= least.upper && 0 <= least.at && least.at <= 1);
  const Rational lower = square_of(least.lower), upper = square_of(least.upper);
  EXPECT_GE(cmp(upper, square_of_distance(motion, Dyadic(least.at))), 0);
  for (int i = 0; i <= 64; ++i)
    EXPECT_LE(cmp(lower, square_of_distance(motion, Dyadic(0x1p-6 * i))), 0) << "at " << i << "/64";
  for (const double near : {-0x1p-10, 0x1p-10, -0x1p-20, 0x1p-20}) {
    const double u = std::clamp(least.at + near, 0.0, 1.0);
    EXPECT_LE(cmp(lower, square_of_distance(motion, Dyadic(u))), 0) << "near its time";
  }
}

template <class M>
void expect_tight(const M& motion, double within) {
  const LeastDistance least = least_distance(Curves<M::dimension>(motion), 0, 1);
  EXPECT_LE(least.upper - least.lower, within);
}

TEST(LeastDistance, EnclosesThatOfRandomMotions) {
  Random random(1);
  for (unsigned round = 0; round < rounds(100U); ++round) {
    for (const double scale : {1.0, 1e-290, 1e290}) {
      const auto line = random_motion<BezierMotion<2, 1>>(random, scale);
      expect_enclosed(line);
      expect_tight(line, 1e-9 * scale);
      const auto cubic = random_motion<BezierMotion<3, 3>>(random, scale);
      expect_enclosed(cubic);
      expect_tight(cubic, 1e-9 * scale);
    }
  }
}

// |d|^2 = |d0|^2 + 2 u d0 e + u^2 |e|^2 is least where its derivative is zero, or at an end of the step.
TEST(LeastDistance, HasTheLeastOneOfLinearMotion) {
  Random random(2);
  for (unsigned round = 0; round < rounds(200U); ++round) {
    const auto motion = random_motion<Space>(random, 1);
    const Rational at_start = square_of_distance(motion, Dyadic(0.0)),
                   at_end = square_of_distance(motion, Dyadic(1.0));
    Rational product = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Rational d = Rational(motion.coordinate(1, 0, axis)) - Rational(motion.coordinate(0, 0, axis));
      const Rational e =
          Rational(motion.coordinate(1, 1, axis)) - Rational(motion.coordinate(0, 1, axis)) - d;
      product += d * e;
      square += e * e;
    }
    Rational least = cmp(at_start, at_end) < 0 ? at_start : at_end;
    const Rational u = -product / square;
    if (cmp(u, Rational(0)) > 0 && cmp(u, Rational(1)) < 0) least = at_start - product * product / square;
    const LeastDistance found = least_distance(Curves<3>(motion), 0, 1);
    EXPECT_LE(cmp(square_of(found.lower), least), 0);
    EXPECT_GE(cmp(square_of(found.upper), least), 0);
    EXPECT_LE(found.upper - found.lower, 1e-10);
  }
}

TEST(LeastDistance, OfBeadsThatMeetIsZero) {
  const Space through = moving({{0, 0, 0}, {3, 3, 3}}, {{9, 3, 3}, {0, 0, 0}});  // not in the middle
  const LeastDistance crossing =
      least_distance(Curves<3>(moving({{0, 0, 0}, {3, 0, 0}}, {{3, 0, 0}, {-3, 0, 0}})), 0, 1);
  EXPECT_EQ(crossing.lower, 0);
  EXPECT_LT(crossing.upper, 1e-9);
  EXPECT_NEAR(crossing.at, 1.0 / 3, 1e-9);
  expect_enclosed(through);
  const LeastDistance together =
      least_distance(Curves<3>(moving({{1, 2, 3}, {1, 2, 3}}, {{4, 5, 6}, {4, 5, 6}})), 0, 1);
  EXPECT_EQ(together.lower, 0);
  EXPECT_LT(together.upper, 1e-300);
}

TEST(LeastDistance, IsUnknownWhereDoublesOverflow) {
  const double huge = std::numeric_limits<double>::max();
  const LeastDistance least =
      least_distance(Curves<3>(moving({{-huge, 0, 0}, {huge, 0, 0}}, {{0, 0, 0}, {1, 0, 0}})), 0, 1);
  EXPECT_EQ(least.lower, 0);
  EXPECT_EQ(least.upper, HUGE_VAL);
  // The distance is representable as a double, but its margin overflows.
  const Points apart{{-0.5 * huge, 0, 0}, {0.5 * huge, 0, 0}};
  const LeastDistance nearly = least_distance(Curves<3>(moving(apart, apart)), 0, 1);
  EXPECT_EQ(nearly.lower, 0);
  EXPECT_EQ(nearly.upper, HUGE_VAL);
}

}  // namespace
}  // namespace kds::least_distance_test
