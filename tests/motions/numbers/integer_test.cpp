#include "motions/numbers/integer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <vector>

#include "motions/numbers/rational.h"

namespace kds::test::integer_test {
namespace {

__extension__ using Wide = __int128;
__extension__ using WideSize = unsigned __int128;

Integer integer_of(Wide x) {
  const bool negative = x < 0;
  auto rest = negative ? -static_cast<WideSize>(x) : static_cast<WideSize>(x);
  Integer result = static_cast<std::uint64_t>(rest >> 64U);
  result <<= 64;
  result += static_cast<std::uint64_t>(rest);
  return negative ? -result : result;
}

std::vector<long> some_numbers() {
  constexpr auto least = std::numeric_limits<long>::min(), most = std::numeric_limits<long>::max();
  std::vector<long> numbers{least, least + 1, -3, -2, -1, 0, 1, 2, 3, most - 1, most};
  std::mt19937_64 random(7);
  for (int i = 0; i < 20; ++i) numbers.push_back(static_cast<long>(random()) >> (random() % 63));
  return numbers;
}

TEST(Integer, CountsAsNumbersOf128BitsDo) {
  for (const long x : some_numbers()) {
    for (const long y : some_numbers()) {
      const Wide a = x, b = y;
      const Integer p = x, q = y;
      EXPECT_EQ(p + q, integer_of(a + b));
      EXPECT_EQ(p - q, integer_of(a - b));
      EXPECT_EQ(p * q, integer_of(a * b));
      EXPECT_EQ(p * y, integer_of(a * b));
      EXPECT_EQ(y * p, integer_of(a * b));
      EXPECT_EQ(Integer(p) + q - q, p);
      if (b != 0) {
        EXPECT_EQ(p / q, integer_of(a / b));
        EXPECT_EQ(p % q, integer_of(a % b));
      }
      EXPECT_EQ(p < q, a < b);
      EXPECT_EQ(p < y, a < b);
      EXPECT_EQ(x < q, a < b);
      EXPECT_EQ(p == y, a == b);
      EXPECT_EQ(p.compare(q) > 0, a > b);
      const auto bits = static_cast<unsigned>(y & 63);
      EXPECT_EQ(p << bits, integer_of(a * (Wide{1} << bits)));
      EXPECT_EQ(p >> bits, integer_of(a >> bits));  // rounded down
    }
    EXPECT_EQ(-Integer(x), integer_of(-Wide{x}));
    EXPECT_EQ(abs(Integer(x)), integer_of(x < 0 ? -Wide{x} : Wide{x}));
    EXPECT_EQ(Integer(x).sign(), (x > 0) - (x < 0));
    EXPECT_EQ(static_cast<long>(Integer(x)), x);
    EXPECT_EQ(Integer(x).str(), std::to_string(x));
    EXPECT_EQ(Integer(std::to_string(x)), x);
    EXPECT_EQ(Integer(static_cast<unsigned long>(x)).str(), std::to_string(static_cast<unsigned long>(x)));
  }
}

TEST(Integer, IsACopyOfItsOwn) {
  Integer a = 5, b = a;
  b += 1;
  EXPECT_EQ(a, 5);
  const Integer c = std::move(b);
  EXPECT_EQ(c, 6);
  b = 7;  // one that was moved from may be assigned
  a = std::move(b);
  EXPECT_EQ(a, 7);
  const Integer& same = a;
  a = same;
  a += same;
  a *= same;
  EXPECT_EQ(a, 196);
}

TEST(Integer, DoublesAndDigits) {
  EXPECT_EQ(Integer(-0x1p80).str(), "-1208925819614629174706176");
  EXPECT_EQ(Integer(-2.75), -2);
  EXPECT_EQ(static_cast<double>((Integer(1) << 60) + 127), 0x1p60);  // towards zero
  EXPECT_EQ(msb((Integer(1) << 100) - 1), 99U);
  EXPECT_EQ(gcd(Integer(-12), Integer(18)), 6);
  EXPECT_EQ(lcm(Integer(4), Integer(6)), 12);
  EXPECT_EQ(sqrt(Integer(99)), 9);
  EXPECT_THROW(Integer("12x"), std::invalid_argument);
  EXPECT_THROW(Integer(""), std::invalid_argument);
  std::ostringstream out;
  out << Integer(-12) << ' ' << Rational(6, 4);
  EXPECT_EQ(out.str(), "-12 3/2");
}

TEST(Rational, IsInLowestTerms) {
  const Rational half(Integer(-3), Integer(-6));
  EXPECT_EQ(numerator(half), 1);
  EXPECT_EQ(denominator(half), 2);
  EXPECT_EQ(half, Rational(0.5));
  EXPECT_EQ(half.str(), "1/2");
  EXPECT_EQ(Rational(4, 2).str(), "2");
  EXPECT_EQ(Rational(0.1).str(), "3602879701896397/36028797018963968");
}

TEST(Rational, CountsAsFractionsDo) {
  for (int a = -4; a <= 4; ++a) {
    for (int b = 1; b <= 3; ++b) {
      for (int c = -4; c <= 4; ++c) {
        for (int d = 1; d <= 3; ++d) {
          const Rational x(a, b), y(c, d);
          EXPECT_EQ(x + y, Rational(a * d + c * b, b * d));
          EXPECT_EQ(x - y, Rational(a * d - c * b, b * d));
          EXPECT_EQ(x * y, Rational(a * c, b * d));
          if (c != 0) {
            EXPECT_EQ(x / y, Rational(a * d, b * c));
          }
          EXPECT_EQ(x < y, a * d < c * b);
          EXPECT_EQ(x == y, a * d == c * b);
          EXPECT_EQ(x.compare(y) > 0, a * d > c * b);
        }
      }
      EXPECT_EQ(-Rational(a, b), Rational(-a, b));
      EXPECT_EQ(abs(Rational(a, b)), Rational(std::abs(a), b));
      EXPECT_EQ(Rational(a, b).sign(), (a > 0) - (a < 0));
    }
  }
  EXPECT_EQ(static_cast<double>(Rational(-1, 10)), std::nextafter(-0.1, 0));  // towards zero
}

}  // namespace
}  // namespace kds::test::integer_test
