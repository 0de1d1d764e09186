#include "certificates/types/distances.h"

#include <gtest/gtest.h>

#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/searches.h"

namespace kds::contact_test {
namespace {

using test::identity_with;

using Kind = Failure::Kind;

// Makes two balls on a line: bead 0 rests at the origin, and bead 1 moves from x0 to x1.
BezierMotion<1, 1> approach(double x0, double x1, double r0, double r1) {
  BezierMotion<1, 1> motion(2);
  for (int k = 0; k <= 1; ++k) {
    motion.set_coordinate(1, k, 0, k == 0 ? x0 : x1);
    motion.set_radius(0, k, r0);
    motion.set_radius(1, k, r1);
  }
  return motion;
}

template <Motion M>
Failure first(Kernel kernel, const M& motion, int sign, TouchPolicy touches = TouchPolicy::ignored) {
  StageCounts stages;
  return test::first_failure(kernel, Contact({0, 1}, sign), motion, Instant(0), KnownAtStart::unknown, stages,
                             touches);
}

TEST(Contact, BeginsWhereTheBallsMeet) {
  for (const Failure& failure : {first(Kernel::exact, approach(4, 0, 1, 0.5), 1),
                                 first(Kernel::filtered, approach(4, 0, 1, 0.5), 1)}) {
    ASSERT_EQ(failure.kind, Kind::later);
    EXPECT_NEAR(failure.time.lower, 0.625, 1e-12);
  }
  EXPECT_EQ(first(Kernel::filtered, approach(4, 2, 1, 0.5), 1).kind, Kind::never);
  EXPECT_EQ(first(Kernel::filtered, approach(1, 0, 1, 0.5), 1).kind, Kind::at_birth);
}

TEST(Contact, EndsWhereTheyPart) {
  EXPECT_NEAR(first(Kernel::filtered, approach(0, 4, 1, 0.5), -1).time.lower, 0.375, 1e-12);
  EXPECT_EQ(first(Kernel::filtered, approach(0, 1, 1, 0.5), -1).kind, Kind::never);
  EXPECT_EQ(first(Kernel::filtered, approach(4, 0, 1, 0.5), -1).kind, Kind::at_birth);
}

TEST(Contact, TouchingIsNoFailure) {
  BezierMotion<2, 1> passing(2);  // moves along a line at distance 2 = 1.5 + 0.5
  for (int k = 0; k <= 1; ++k) {
    passing.set_coordinate(1, k, 0, k == 0 ? -3 : 1);
    passing.set_coordinate(1, k, 1, 2);
    passing.set_radius(0, k, 1.5);
    passing.set_radius(1, k, 0.5);
  }
  EXPECT_EQ(first(Kernel::exact, passing, 1).kind, Kind::never);
  EXPECT_EQ(first(Kernel::filtered, passing, 1).kind, Kind::never);
  const Failure touch = first(Kernel::filtered, passing, 1, TouchPolicy::reported);
  ASSERT_EQ(touch.kind, Kind::later);
  EXPECT_TRUE(touch.time.touch);
  EXPECT_LE(touch.time.lower, 0.75);
  EXPECT_GE(touch.time.upper, 0.75);
  EXPECT_LT(touch.time.upper - touch.time.lower, 1e-12);
  passing.set_radius(1, 1, std::nextafter(0.5, 1));
  EXPECT_EQ(first(Kernel::filtered, passing, 1).kind, Kind::later);
}

TEST(Contact, RadiiMayChange) {
  auto growing = approach(2, 2, 1, 0.5);
  growing.set_radius(0, 1, 2);
  EXPECT_NEAR(first(Kernel::filtered, growing, 1).time.lower, 0.5, 1e-12);
  EXPECT_EQ(first(Kernel::filtered, growing, -1).kind, Kind::at_birth);
  auto shrinking = approach(2, 2, 2, 0.5);
  shrinking.set_radius(0, 1, 1);
  EXPECT_NEAR(first(Kernel::filtered, shrinking, -1).time.lower, 0.5, 1e-12);
}

template <Motion M>
void expect_distance(test::Random& random, test::MotionKind kind) {
  const auto motion = test::random_motion<M>(random, 2, kind);
  const Dyadic time = test::random_dyadic(random);
  const auto d = test::minus(test::point_at(motion, 1, time), test::point_at(motion, 0, time));
  const auto reach = test::radius_at(motion, 0, time) + test::radius_at(motion, 1, time);
  const int expected = test::sign(test::dot(d, d) - reach * reach);
  EXPECT_EQ(test::sign_at(Contact({1, 0}, 1), motion, time), expected);
  EXPECT_EQ(test::sign_at(Contact({1, 0}, -1), motion, time), -expected);
  EXPECT_EQ(test::exact_function(Contact({0, 1}, 1), motion).sign_at(time), expected);
}

TEST(Contact, IsTheDistanceAgainstTheRadii) {
  test::Random random(731);
  for (int i = 0; i < 60; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("seed 731, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      expect_distance<BezierMotion<1, 1>>(random, kind);
      expect_distance<BezierMotion<2, 2>>(random, kind);
      expect_distance<BezierMotion<3, 3>>(random, kind);
    }
  }
}

TEST(Contact, HasAnIdentityByBeads) {
  constexpr std::uint32_t type = Contact::type.number;
  EXPECT_EQ(Contact({3, 1}, 1).identity(), identity_with(type, {1, 3}));
  EXPECT_EQ(Contact({3, 1}, 1).identity(), Contact({1, 3}, -1).identity());
}

}  // namespace
}  // namespace kds::contact_test
