#include "certificates/exact/ball_number.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/inputs/random.h"

namespace kds::ball_number_test {
namespace {

using test::pick;
using test::Random;

Rational power_of_two(std::int64_t exponent) {
  const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? fraction(1, power) : Rational(power);
}

void expect_encloses(const BallNumber& x, const Rational& exact) {
  if (x.certain_sign() != 0) {
    EXPECT_EQ(x.certain_sign(), sgn(exact));
  }
  if (x.is_zero()) {
    EXPECT_EQ(exact, 0);
    return;
  }
  if (exact != 0) {
    EXPECT_LT(abs(exact), power_of_two(x.top_bit()));
  }
  // In fine units the error is that of the ball, in coarse ones that of rounding.
  const std::int64_t unit = std::min(x.lowest_bit(), x.radius_bit().value_or(x.lowest_bit()) - 8);
  for (const std::int64_t power : {unit, unit + 8, unit + 200}) {
    Integer error;
    const Integer number = x.in_units(power, error);
    EXPECT_LE(abs(Rational(exact / power_of_two(power) - number)), Rational(error));
  }
}

Integer random_integer(Random& random) {
  Integer x = static_cast<std::int64_t>(random()) >> pick(random, 0, 62);
  if (random() % 3 == 0)
    x = (x << static_cast<unsigned>(pick(random, 0, 400))) + static_cast<std::int64_t>(random());
  return x << static_cast<unsigned>(random() % 2 == 0 ? 0 : pick(random, 0, 900));
}

class BallNumbers : public testing::TestWithParam<std::size_t> {};

// Compares sums and products of numbers of similar and very different sizes, with cancellation, with
// rationals.
TEST_P(BallNumbers, EncloseTheExactNumber) {
  const std::size_t bits = GetParam();
  Random random(1101 + bits % 1000);
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Integer first = random_integer(random);
    BallNumber x(first, bits);
    Rational exact = first;
    for (int step = 0; step < 12; ++step) {
      const Integer next = random_integer(random);
      BallNumber y(next, bits);
      Rational other = next;
      if (random() % 3 == 0) {  // almost the present sum with the opposite sign
        y = -x;
        other = -exact;
        y += BallNumber(next, bits);
        other += next;
      }
      switch (random() % 4) {
        case 0:
          x += y;
          exact += other;
          break;
        case 1:
          x -= y;
          exact -= other;
          break;
        case 2:
          x *= y;
          exact *= other;
          break;
        default:
          add_product(x, y, BallNumber(next, bits));
          exact += other * next;
      }
      SCOPED_TRACE("bits " + std::to_string(bits) + ", case " + std::to_string(i));
      expect_encloses(x, exact);
      if (bits == BallNumber::unlimited) {
        EXPECT_FALSE(x.radius_bit());
      }
    }
  }
}

TEST_P(BallNumbers, ContainAllNumbersBetweenTwo) {
  Random random(1104);
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Integer low = abs(random_integer(random)), high = low + abs(random_integer(random));
    const BallNumber all = BallNumber::between(low, high, GetParam());
    SCOPED_TRACE("case " + std::to_string(i));
    for (const Integer& x : {low, high, Integer((low + high) / 2)}) expect_encloses(all, x);
  }
}

INSTANTIATE_TEST_SUITE_P(OfAnyPrecision, BallNumbers,
                         testing::Values(64, 128, 300, 2000, BallNumber::unlimited));

TEST(BallNumber, KeepsWhatFits) {
  const Integer wide = (Integer(1) << 127) + 1;
  EXPECT_FALSE(BallNumber(wide, 128).radius_bit());
  EXPECT_TRUE((BallNumber(wide, 128) - BallNumber(wide, 128)).is_zero());
  EXPECT_FALSE(BallNumber(Integer(5) << 1000, 128).radius_bit());
  const BallNumber more((Integer(5) << 1000) + 1, 128);
  EXPECT_TRUE(more.radius_bit());
  EXPECT_TRUE(more.has_digits(120));
  EXPECT_FALSE(more.has_digits(200));
}

TEST(BallNumber, HasNoMorePrecisionThanItsOperands) {
  BallNumber x(Integer(1), 2000);
  x += BallNumber(Integer(1) << 300, 128);
  EXPECT_TRUE(x.radius_bit());
  EXPECT_FALSE(BallNumber(Integer((Integer(1) << 300) + 1), 2000).radius_bit());
  EXPECT_TRUE(BallNumber(Integer((Integer(1) << 300) + 1), 2000).rounded(128).radius_bit());
}

TEST(BallNumber, IsExactWithoutALimit) {
  BallNumber x(Integer(3), BallNumber::unlimited);
  x *= BallNumber(Integer(1) << 5000, BallNumber::unlimited);
  x += BallNumber(Integer(-1), BallNumber::unlimited);
  Integer error;
  EXPECT_EQ(x.in_units(0, error), (Integer(3) << 5000) - 1);
  EXPECT_EQ(error, 0);
  EXPECT_TRUE(x.has_digits(6000));
}

TEST(BallNumber, HasAnUnknownSignIfItsRadiusReachesZero) {
  EXPECT_EQ(BallNumber::around(Integer(1), 2, 128).certain_sign(), 0);
  EXPECT_EQ(BallNumber::around(Integer(-5), 2, 128).certain_sign(), -1);
}

}  // namespace
}  // namespace kds::ball_number_test
