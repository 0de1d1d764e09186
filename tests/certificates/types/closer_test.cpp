#include "certificates/types/distances.h"

#include <gtest/gtest.h>

#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/searches.h"

namespace kds::closer_test {
namespace {

test::second::Rational square(const test::RationalPoint& a, const test::RationalPoint& b) {
  return test::dot(test::minus(a, b), test::minus(a, b));
}

template <Motion M>
void expect_sign_of_the_difference(unsigned seed) {
  test::Random random(seed);
  for (int i = 0; i < 20; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<M>(random, 4, kind);
      const Dyadic time = test::random_dyadic(random);
      std::array<test::RationalPoint, 4> at;
      for (BeadId b = 0; b < 4; ++b) at[b] = test::point_at(motion, b, time);
      const test::second::Rational first = square(at[0], at[1]), second = square(at[2], at[3]),
                                   shared = square(at[1], at[3]);
      EXPECT_EQ(test::sign_at(Closer({0, 1}, {2, 3}), motion, time), test::sign(second - first));
      EXPECT_EQ(test::sign_at(Closer({2, 3}, {0, 1}), motion, time), test::sign(first - second));
      EXPECT_EQ(test::sign_at(Closer({0, 1}, {1, 3}), motion, time), test::sign(shared - first));
      EXPECT_EQ(test::sign_at(Closer({1, 3}, {0, 1}), motion, time), test::sign(first - shared));
    }
  }
}

TEST(Closer, IsTheSignOfTheDifferenceOfSquares) {
  expect_sign_of_the_difference<BezierMotion<2, 1>>(41);
  expect_sign_of_the_difference<BezierMotion<2, 3>>(42);
  expect_sign_of_the_difference<BezierMotion<3, 3>>(43);
}

TEST(Closer, HasOneIdentityBothWays) {
  const Closer one({5, 7}, {2, 9}), other({2, 9}, {5, 7});
  EXPECT_EQ(one.identity(), other.identity());
  EXPECT_NE(one.side(), other.side());
  EXPECT_NE(one.identity(), Closer({5, 9}, {2, 7}).identity());
}

}  // namespace
}  // namespace kds::closer_test
