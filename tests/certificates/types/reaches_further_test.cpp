#include "certificates/types/reaches_further.h"

#include <gtest/gtest.h>

#include <set>

#include "certificates/search/support_searches.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/searches.h"
#include "tests/support/text_of.h"

namespace kds::reaches_further_test {
namespace {

using namespace test;

/// All directions of a dimension and their opposites.
std::vector<SlabDirection> all_directions(int dimension) {
  std::vector<SlabDirection> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = dimension == 2 ? 0 : -1; z <= (dimension == 2 ? 0 : 1); ++z)
        if (x != 0 || y != 0 || z != 0)
          all.push_back(
              {{static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)}});
  return all;
}

/// Returns the sign of a + b sqrt(square) from the definition.
int sign_of_sum(const Rational& a, const Rational& b, int square) {
  if (a >= 0 && b >= 0) return a > 0 || b > 0 ? 1 : 0;
  if (a <= 0 && b <= 0) return -1;
  const Rational a2 = a * a, b2 = square * b * b;
  if (a2 == b2) return 0;
  return (a2 > b2 ? a : b) > 0 ? 1 : -1;
}

/// Returns how the reach of bead 1 compares with that of bead 0.
template <class M>
int judged(const M& motion, const SlabDirection& direction, bool with_radii, const Dyadic& time) {
  const Ball a = ball_at(motion, 0, time), b = ball_at(motion, 1, time);
  Rational along = 0;
  for (std::size_t axis = 0; axis < M::dimension; ++axis)
    along += direction.steps[axis] * (b.center[axis] - a.center[axis]);
  return sign_of_sum(along, with_radii ? Rational(b.radius - a.radius) : Rational(0), direction.square());
}

template <class C, class M>
int sign_at_time(const C& certificate, const M& motion, const Dyadic& time) {
  return search_over<C>(MotionRef<M::dimension>(motion))->sign_at(certificate, time);
}

/// Compares signs, and the failures that each kernel finds, with the definition.
template <class C, class M>
void compare_with_definition(unsigned seed) {
  constexpr bool with_radii = std::is_same_v<C, BallReachesFurther>;
  const auto directions = all_directions(M::dimension);
  Random random(seed);
  std::array<int, 3> signs{};
  int failures = 0;
  for (int round = 0; round < 4; ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      auto motion = random_motion<M>(random, 2, kind);
      for (BeadId b = 0; round % 2 == 0 && b < 2; ++b)  // balls that are level along the first axis
        for (int k = 0; k <= M::degree; ++k) motion.set_radius(b, k, 4 - motion.coordinate(b, k, 0));
      for (const SlabDirection& direction : directions) {
        SCOPED_TRACE(
            text_of("round ", round, ", kind ", static_cast<int>(kind), ", direction ", direction.number()));
        const C certificate(1, 0, direction), opposite(0, 1, direction);
        const Dyadic time = random_dyadic(random);
        const int expected = judged(motion, direction, with_radii, time);
        ++signs[static_cast<std::size_t>(expected + 1)];
        ASSERT_EQ(sign_at_time(certificate, motion, time), expected);
        ASSERT_EQ(sign_at_time(opposite, motion, time), -expected);
        ASSERT_EQ(certificate.identity(), opposite.identity());

        StageCounts stages;
        const auto failure_with = [&](Kernel kernel) {
          return first_failure(kernel, certificate, motion, Instant(0), KnownAtStart::unknown, stages);
        };
        const Failure exact = failure_with(Kernel::exact), filtered = failure_with(Kernel::filtered);
        ASSERT_EQ(exact.kind, filtered.kind);
        const auto sign_at = [&](double u) { return judged(motion, direction, with_radii, Dyadic(u)); };
        if (exact.kind == Failure::Kind::at_birth) {
          ASSERT_LE(sign_at(0), 0);
          continue;
        }
        double end = 1;
        if (exact.kind == Failure::Kind::later) {
          ++failures;
          ASSERT_LE(filtered.time.lower, exact.time.upper);
          ASSERT_GE(filtered.time.upper, exact.time.lower);
          ASSERT_GE(sign_at(filtered.time.lower), 0);
          ASSERT_LE(sign_at(filtered.time.upper), 0);
          end = filtered.time.lower;
        }
        for (int i = 0; i <= 8; ++i) {
          const int sign = sign_at(i / 8.0 * end);
          ASSERT_TRUE(exact.kind == Failure::Kind::zero ? sign == 0 : sign >= 0);
        }
      }
    }
  }
  EXPECT_GT(signs[0], 50);
  EXPECT_GT(signs[1], 5);
  EXPECT_GT(signs[2], 50);
  EXPECT_GT(failures, 30);
}

TEST(ReachesFurther, IsTheOrderAlongTheDirection) {
  compare_with_definition<ReachesFurther, BezierMotion<2, 1>>(861);
  compare_with_definition<ReachesFurther, BezierMotion<3, 1>>(862);
  compare_with_definition<ReachesFurther, BezierMotion<3, 3>>(863);
}
TEST(BallReachesFurther, IsTheOrderOfTheBallsAlongTheDirection) {
  compare_with_definition<BallReachesFurther, BezierMotion<2, 1>>(864);
  compare_with_definition<BallReachesFurther, BezierMotion<3, 1>>(865);
  compare_with_definition<BallReachesFurther, BezierMotion<3, 3>>(866);
}

TEST(BallReachesFurther, FailsWhereTheBallsAreLevel) {
  BezierMotion<2, 1> motion(2);
  for (int k = 0; k <= 1; ++k) {
    motion.set_coordinate(0, k, 0, 0);
    motion.set_coordinate(0, k, 1, 0);
    motion.set_coordinate(1, k, 0,
                          k == 0 ? 1 : -3);  // 1 - 4u, and 1.5 more in radius
    motion.set_coordinate(1, k, 1, 0);
    motion.set_radius(0, k, 1);
    motion.set_radius(1, k, 2.5);
  }
  StageCounts stages;
  for (const Kernel kernel : all_kernels) {
    const auto time = [&](const SlabDirection& direction) {
      const Failure failure = first_failure(kernel, BallReachesFurther(1, 0, direction), motion, Instant(0),
                                            KnownAtStart::unknown, stages);
      EXPECT_EQ(failure.kind, Failure::Kind::later);
      return 0.5 * (failure.time.lower + failure.time.upper);
    };
    EXPECT_NEAR(time({{1, 0, 0}}), 2.5 / 4, 1e-9);
    EXPECT_NEAR(time({{1, 1, 0}}), (1 + 1.5 * std::sqrt(2.0)) / 4, 1e-9);
    EXPECT_NEAR(time({{1, -1, 0}}), (1 + 1.5 * std::sqrt(2.0)) / 4, 1e-9);
  }
}

// Names differ for different functions. For beads of equal radii, opposite directions have one function.
TEST(ReachesFurther, IsNamedByItsBeadsAndDirection) {
  std::set<Identity> points, balls;
  for (const SlabDirection& direction : all_directions(3)) {
    points.insert(ReachesFurther(4, 7, direction).identity());
    balls.insert(BallReachesFurther(4, 7, direction).identity());
    EXPECT_EQ(ReachesFurther(4, 7, direction).identity(),
              ReachesFurther(4, 7, direction.opposite()).identity());
    EXPECT_NE(ReachesFurther(4, 7, direction).side(), ReachesFurther(4, 7, direction.opposite()).side());
  }
  EXPECT_EQ(points.size(), 13U);
  EXPECT_EQ(balls.size(), 26U);
}

}  // namespace
}  // namespace kds::reaches_further_test
