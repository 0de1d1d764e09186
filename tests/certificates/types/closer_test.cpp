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

// The difference of beads 4 and 5 is a shift of the second pair's second bead.
TEST(Closer, TakesShifts) {
  test::Random random(44);
  for (int i = 0; i < 20; ++i) {
    const auto motion = test::random_motion<BezierMotion<3, 1>>(
        random, 6, test::all_motion_kinds[static_cast<std::size_t>(i) % test::all_motion_kinds.size()]);
    const Dyadic time = test::random_dyadic(random);
    std::array<test::RationalPoint, 6> at;
    for (BeadId b = 0; b < 6; ++b) at[b] = test::point_at(motion, b, time);
    const test::RationalPoint shift = test::minus(at[4], at[5]);
    test::RationalPoint moved = at[3];
    for (std::size_t axis = 0; axis < moved.size(); ++axis) moved[axis] += shift[axis];
    EXPECT_EQ(test::sign_at(Closer({{0, 1}}, {{2, 3}, {4, 5}}), motion, time),
              test::sign(square(at[2], moved) - square(at[0], at[1])));
  }
}

TEST(Closer, HasOneIdentityBothWays) {
  const Closer one({5, 7}, {2, 9}), other({2, 9}, {5, 7});
  EXPECT_EQ(one.identity(), other.identity());
  EXPECT_NE(one.side(), other.side());
  EXPECT_NE(one.identity(), Closer({5, 9}, {2, 7}).identity());
  const Closer::Pair image{{5, 7}, {10, 11}}, other_image{{5, 7}, {12, 13}}, pair{{2, 9}};
  EXPECT_EQ(Closer(image, pair).identity(), Closer(pair, image).identity());
  EXPECT_NE(Closer(image, pair).identity(), Closer(other_image, pair).identity());
  EXPECT_NE(Closer(image, other_image).side(), Closer(other_image, image).side());
}

}  // namespace
}  // namespace kds::closer_test
