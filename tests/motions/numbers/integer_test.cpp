#include "motions/numbers/exact_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace kds::test::integer_test {
namespace {

TEST(Integer, HasBits) {
  EXPECT_EQ(bit_length(0), 1U);
  EXPECT_EQ(bit_length(-1), 1U);
  EXPECT_EQ(bit_length((Integer(1) << 100) - 1), 100U);
  EXPECT_EQ(bit_length(-(Integer(1) << 100)), 101U);
}

// Checks the rounding rules of GMP on which the exact stage relies.
TEST(Integer, RoundsAsIsSaid) {
  EXPECT_EQ(Integer(-2.75), -2);
  EXPECT_EQ(Integer((Integer(1) << 60) + 127).get_d(), 0x1p60);  // rounds towards zero
  EXPECT_EQ(Integer(-5) >> 1, -3);                               // rounds down
  EXPECT_EQ(Integer(-5) / 2, -2);
  EXPECT_EQ(Integer(-5) % 2, -1);
  EXPECT_EQ(sqrt(Integer(99)), 9);
  EXPECT_EQ(Integer(INT64_MIN), -(Integer(1) << 63));
  EXPECT_EQ(Integer(UINT64_MAX), (Integer(1) << 64) - 1);
}

TEST(Rational, IsInLowestTerms) {
  const Rational half = fraction(-3, -6);
  EXPECT_EQ(numerator(half), 1);
  EXPECT_EQ(denominator(half), 2);
  EXPECT_EQ(half, Rational(0.5));
  EXPECT_EQ(half.get_str(), "1/2");
  EXPECT_EQ(fraction(4, 2).get_str(), "2");
  EXPECT_EQ(Rational(0.1).get_str(), "3602879701896397/36028797018963968");
  EXPECT_EQ(fraction(-1, 10).get_d(), std::nextafter(-0.1, 0));  // rounds towards zero
}

}  // namespace
}  // namespace kds::test::integer_test
