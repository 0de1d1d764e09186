// Comparisons of pairs of balls whose distances are almost or exactly equal, checked over rationals.

#include "structures/necklace/ball_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/ball_gaps.h"
#include "tests/support/rounds.h"

namespace kds::ball_distance_test {
namespace {

using namespace test;

int sign_of(const Rational& x) { return (x > 0) - (x < 0); }

Rational square(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Rational sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational x = Rational(a[axis]) - Rational(b[axis]);
    sum += x * x;
  }
  return sum;
}

/// Returns a point of a coarse grid, in some cases moved by an ulp or two.
Eigen::Vector3d near_grid(Random& random, double scale) {
  Eigen::Vector3d point;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    point[axis] = static_cast<double>(random() % 7) - 3;
    if (point[axis] != 0 && random() % 40 == 0)
      point[axis] = std::nextafter(point[axis], random() % 2 == 0 ? 9.0 : -9.0);
    if (random() % 80 == 0) point[axis] += 0x1p-30;
  }
  return scale * point;
}

TEST(BallDistance, OfPointsNearAGridAtAnyScale) {
  Random random(5);
  unsigned ties = 0;
  for (unsigned k = 0; k < rounds(20000U) && !testing::Test::HasFailure(); ++k) {
    constexpr std::array<double, 7> scales{1, 1.1, 0x1p-300, 0x1p-470, 0x1p-530, 0x1p478, 0x1p700};
    const double scale = scales[random() % scales.size()];
    const auto point = [&] { return near_grid(random, scale); };
    const Eigen::Vector3d a = point(), b = point(), c = point(), d = point();
    const double r = scale * static_cast<double>(random() % 3), s = std::abs(point()[0]);
    const Rational reach = Rational(r) + Rational(s);
    const int distance = sign_of(square(a, b) - reach * reach);
    ASSERT_EQ(compare_distance(a, b, r, s), distance) << scale;
    const Rational room = Rational(r) - Rational(s);
    ASSERT_EQ(compare_distance(a, b, r, -s), sign_of(square(a, b) - room * room)) << scale;
    const int gap = sign_of(square(a, b) - square(c, d));
    ASSERT_EQ(compare_gaps(a, b, {r, s}, c, d, {r, s}), gap) << scale;
    ASSERT_EQ(compare_gaps(a, b, {s, r}, c, d, {r, s}), gap) << scale;
    ASSERT_EQ(compare_gaps(a, b, {0, 0}, c, d, {s, -s}), gap) << scale;
    ties += (distance == 0 ? 1 : 0) + (gap == 0 ? 1 : 0);
  }
  EXPECT_GT(ties, rounds(20000U) / 50);
}

TEST(BallDistance, OfGapsWithUnequalRadii) {
  Random random(6);
  unsigned ties = 0;
  for (unsigned k = 0; k < rounds(4000U) && !testing::Test::HasFailure(); ++k) {
    const bool on_a_line = random() % 2 == 0;
    const auto point = [&]() -> Eigen::Vector3d {
      const Eigen::Vector3d place = near_grid(random, 1);
      return on_a_line ? Eigen::Vector3d(place[0], 0, 0) : place;
    };
    const Eigen::Vector3d a = point(), b = point(), c = point(), d = point();
    const auto radius = [&] { return static_cast<double>(random() % 3) / 2; };
    const ExactSum r{radius(), radius()}, s{radius(), radius()};
    const int expected =
        compare_gap_units(gap_in_units(a, b, r.first, r.second), gap_in_units(c, d, s.first, s.second));
    ASSERT_EQ(compare_gaps(a, b, r, c, d, s), expected);
    ties += expected == 0 ? 1 : 0;
  }
  EXPECT_GT(ties, rounds(4000U) / 100);
}

TEST(ExactTotal, SumsAreNotRounded) {
  Random random(7);
  for (unsigned k = 0; k < rounds(5000U) && !testing::Test::HasFailure(); ++k) {
    ExactTotal total;
    Rational expected = 0;
    for (unsigned term = 0; term < 8; ++term) {
      const auto wide = [&] {
        return std::ldexp(static_cast<double>(random() >> 11U), int(random() % 240) - 160);
      };
      const TwoTerms x = exact_sum(wide(), random() % 2 == 0 ? -wide() : 0.0);
      const Rational value = Rational(x.high) + Rational(x.low);
      const bool plus = random() % 2 == 0;
      plus ? total.add_square(x) : total.subtract_square(x);
      expected += plus ? value * value : Rational(-value * value);
      if (term % 2 == 1 && random() % 2 == 0) {  // cancels the previous term
        plus ? total.subtract_square(x) : total.add_square(x);
        expected -= plus ? value * value : Rational(-value * value);
        ++term;
      }
    }
    ASSERT_TRUE(total.is_exact());
    ASSERT_EQ(total.sign(), sign_of(expected));
  }
}

TEST(ExactTotal, WhatOverOrUnderflowsIsNotExact) {
  for (const double x : {0x1p500, 0x1p1000, 0x1p-500, 0x1p-1070}) {
    ExactTotal total;
    total.add_square({x, 0});
    EXPECT_FALSE(total.is_exact()) << x;
  }
  ExactTotal total;
  total.add_square(exact_sum(0x1p1023, 0x1p1023));
  EXPECT_FALSE(total.is_exact());
  EXPECT_EQ(ExactTotal().sign(), 0);
}

}  // namespace
}  // namespace kds::ball_distance_test
