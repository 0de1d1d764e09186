#include "motions/numbers/exact_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace kds::exact_number_test {
namespace {

constexpr double huge = std::numeric_limits<double>::max();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double tiny = std::numeric_limits<double>::denorm_min();

double random_double(std::mt19937_64& random) {
  while (true) {
    const auto x = std::bit_cast<double>(random());
    if (std::isfinite(x)) return x;
  }
}

std::vector<double> interesting() {
  std::vector<double> values{0.0,
                             -0.0,
                             1,
                             -1,
                             0.1,
                             -0.1,
                             tiny,
                             -tiny,
                             3 * tiny,
                             huge,
                             -huge,
                             0x1p-1022,
                             -0x1p-1022,
                             std::nextafter(0x1p-1022, 0),
                             0x1.fffffffffffffp-1000,
                             0x1p1000,
                             6,
                             0.75};
  std::mt19937_64 random(11);
  for (int i = 0; i < 2000; ++i) values.push_back(random_double(random));
  return values;
}

Rational power_of_two(int exponent) {
  return exponent >= 0 ? Rational(Integer(1) << static_cast<unsigned>(exponent))
                       : fraction(1, Integer(1) << static_cast<unsigned>(-exponent));
}

TEST(Split, PutsTogetherAgain) {
  for (const double x : interesting()) {
    const SplitDouble parts = split(x);
    EXPECT_EQ(Rational(parts.mantissa) * power_of_two(parts.exponent), Rational(x));
    if (x == 0) {
      EXPECT_EQ(parts.mantissa, 0);
      EXPECT_EQ(parts.exponent, 0);
    } else {
      EXPECT_NE(parts.mantissa % 2, 0);
    }
  }
}

TEST(Dyadic, HoldsADoubleExactly) {
  for (const double x : interesting()) {
    const Dyadic d(x);
    EXPECT_EQ(d.rational(), Rational(x));
    EXPECT_EQ(d.round_down(), x);
    EXPECT_EQ(d.round_up(), x);
    EXPECT_TRUE(d.exponent() == 0 || d.numerator() % 2 != 0);
  }
}

TEST(Dyadic, IsKeptReduced) {
  const Dyadic a(Integer(12), 4);
  EXPECT_EQ(a.numerator(), 3);
  EXPECT_EQ(a.exponent(), 2U);
  const Dyadic b(Integer(-12), 1);
  EXPECT_EQ(b.numerator(), -6);
  EXPECT_EQ(b.exponent(), 0U);
  const Dyadic zero(Integer(0), 90);
  EXPECT_EQ(zero.exponent(), 0U);
  EXPECT_EQ(zero, Dyadic());
}

// Checks the doubles next to a dyadic number by rationals.
void expect_rounded(const Dyadic& d) {
  const double down = d.round_down();
  const double up = d.round_up();
  const Rational x = d.rational();
  if (down == -inf) {
    EXPECT_LT(x, Rational(-huge));
  } else {
    EXPECT_LE(Rational(down), x);
    const double next = std::nextafter(down, inf);
    EXPECT_TRUE(next == inf || Rational(next) > x) << x;
  }
  if (up == inf) {
    EXPECT_GT(x, Rational(huge));
  } else {
    EXPECT_GE(Rational(up), x);
    const double next = std::nextafter(up, -inf);
    EXPECT_TRUE(next == -inf || Rational(next) < x) << x;
  }
}

TEST(Dyadic, RoundsToTheNextDoubles) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 3000; ++i) {
    Integer numerator = random();
    numerator = (numerator << 64) + random();
    if (random() % 4 == 0) numerator >>= static_cast<unsigned>(random() % 128);
    if (random() % 2) numerator = -numerator;
    const auto exponent = static_cast<unsigned>(random() % 3 == 0 ? 1000 + random() % 300 : random() % 200);
    if (random() % 8 == 0) numerator <<= 1000U + static_cast<unsigned>(random() % 60);
    expect_rounded(Dyadic(numerator, exponent));
  }
}

TEST(Dyadic, RoundsAtTheEdges) {
  const Integer one = 1;
  for (const int sign : {1, -1}) {
    for (const unsigned exponent : {1021U, 1022U, 1023U, 1073U, 1074U, 1075U, 1076U, 1200U, 5000U}) {
      for (const int around : {-1, 0, 1}) {
        for (const unsigned extra : {0U, 1U, 60U, 200U})
          expect_rounded(Dyadic(((one << extra) + around) * sign, exponent + extra));
      }
    }
    for (const unsigned bits : {1023U, 1024U, 1025U, 4000U}) {
      for (const int around : {-1, 0, 1}) expect_rounded(Dyadic(((one << bits) + around) * sign, 0));
    }
    const Integer largest = (one << 1024) - (one << 971);
    for (const int around : {-1, 0, 1}) expect_rounded(Dyadic((largest + around) * sign, 0));
  }
  EXPECT_EQ(Dyadic(one, 2000).round_down(), 0);
  EXPECT_EQ(Dyadic(one, 2000).round_up(), tiny);
  EXPECT_EQ(Dyadic(-one, 2000).round_down(), -tiny);
  EXPECT_EQ(Dyadic(-one, 2000).round_up(), 0);
  EXPECT_EQ(Dyadic(one << 1024, 0).round_up(), inf);
  EXPECT_EQ(Dyadic(one << 1024, 0).round_down(), huge);
}

TEST(Dyadic, ComparesAndHalvesAsRationals) {
  std::mt19937_64 random(13);
  const auto draw = [&] {
    const Integer numerator = static_cast<std::int64_t>(random() % 41) - 20;
    return Dyadic(numerator, static_cast<unsigned>(random() % 5));
  };
  for (int i = 0; i < 3000; ++i) {
    const Dyadic a = random() % 8 == 0 ? Dyadic(random_double(random)) : draw();
    const Dyadic b = random() % 8 == 0 ? Dyadic(random_double(random)) : draw();
    const Rational x = a.rational();
    const Rational y = b.rational();
    EXPECT_EQ(Dyadic::compare(a, b), (x > y) - (x < y));
    EXPECT_EQ(a == b, x == y);
    EXPECT_EQ(a < b, x < y);
    EXPECT_EQ(a <= b, x <= y);
    EXPECT_EQ(Dyadic::midpoint(a, b).rational(), (x + y) / 2);
  }
}

}  // namespace
}  // namespace kds::exact_number_test
