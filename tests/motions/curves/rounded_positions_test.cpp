// The difference between rounded and exact positions is within the stated bounds.

#include "motions/curves/positions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::rounded_positions_test {
namespace {

using namespace test;

bool is_within(const Rational& exact, double value, double error) {
  if (!std::isfinite(error)) return true;
  const Rational off = exact - Rational(value), bound = Rational(error) * Rational(TrackedDouble::inflation);
  return off <= bound && -off <= bound;
}

template <Motion M>
void expect_within_bounds(const M& motion, const Dyadic& time) {
  const RoundedPositions<M::dimension> rounded(MotionRef<M::dimension>(motion), time);
  ASSERT_EQ(rounded.size(), motion.bead_count());
  for (BeadId b = 0; b < rounded.size(); ++b) {
    const auto exact = exact_position(motion, b, time);
    for (std::size_t axis = 0; axis < M::dimension; ++axis)
      EXPECT_TRUE(is_within(exact[axis], rounded.row(b)[axis], rounded.coordinate_error()));
    EXPECT_TRUE(is_within(exact.back(), rounded.row(b)[M::dimension], rounded.weight_error()));
    EXPECT_TRUE(is_within(exact_radius(motion, b, time), rounded.radius(b).value, rounded.radius(b).error));
  }
}

TEST(RoundedPositions, AreWithinTheirBounds) {
  Random random(11);
  for (const MotionKind kind : all_motion_kinds) {
    for (const Dyadic& time : {Dyadic(0.0), Dyadic(1.0), Dyadic(0.37), Dyadic(Integer(1), 90),
                               Dyadic((Integer(1) << 100U) - 1, 100)}) {
      auto line = random_motion<BezierMotion<3, 1>>(random, 12, kind);
      for (BeadId b = 0; b < 12; ++b)
        for (int k = 0; k < 2; ++k) {
          line.set_weight(b, k, uniform(random, 0, 9));
          line.set_radius(b, k, uniform(random, 0, 3));
        }
      expect_within_bounds(line, time);
      expect_within_bounds(random_motion<BezierMotion<2, 3>>(random, 12, kind), time);
    }
  }
}

TEST(RoundedPositions, OfLiftedMotionHaveItsWeights) {
  Random random(12);
  LiftedMotion<3> motion(9);
  for (BeadId b = 0; b < 9; ++b)
    for (int k = 0; k < 2; ++k) {
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, k, axis, uniform(random));
      motion.set_weight(b, k, uniform(random));
    }
  motion.set_drift({0.25, -1, 3});
  expect_within_bounds(motion, Dyadic(0.4));
}

TEST(RoundedPositions, HaveBoundsUpToTheLargestNumbers) {
  constexpr double largest = std::numeric_limits<double>::max();
  BezierMotion<2, 1> motion(1);
  for (int k = 0; k < 2; ++k) motion.set_coordinate(0, k, 0, largest);
  const RoundedPositions<2> rounded(MotionRef<2>(motion), Dyadic(0.3));
  EXPECT_LT(rounded.coordinate_error(), largest * 0x1p-48);
  EXPECT_TRUE(
      is_within(exact_position(motion, 0, Dyadic(0.3))[0], rounded.row(0)[0], rounded.coordinate_error()));
}

// A NaN bound of one bead must not be lost among the finite bounds of the others.
TEST(RoundedPositions, WithoutABoundWhereNumbersOverflow) {
  constexpr double largest = std::numeric_limits<double>::max();
  for (const BeadId far : {0U, 1U, 2U}) {
    LiftedMotion<2> motion(3);
    for (BeadId b = 0; b < 3; ++b)
      for (int k = 0; k < 2; ++k) motion.set_coordinate(b, k, 0, b + 0.5 * k);
    motion.set_coordinate(far, 0, 1, -largest / 4);  // the square of this coordinate's range overflows
    motion.set_coordinate(far, 1, 1, largest / 4);
    for (const Dyadic& time : {Dyadic(0.0), Dyadic(0.3), Dyadic(1.0)}) {
      const RoundedPositions<2> rounded(MotionRef<2>(motion), time);
      EXPECT_EQ(rounded.weight_error(), std::numeric_limits<double>::infinity()) << far;
      EXPECT_TRUE(std::isfinite(rounded.coordinate_error())) << far;
    }
  }
}

}  // namespace
}  // namespace kds::rounded_positions_test
