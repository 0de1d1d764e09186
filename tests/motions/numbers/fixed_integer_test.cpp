// Compares integers of a fixed width with integers of any width.

#include "motions/numbers/fixed_integer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace kds::fixed_integer_test {
namespace {

/// A number of about the given number of bits, and its fixed-width version.
struct Both {
  Integer whole = 0;
  FixedInteger fixed;
};

Both random_number(std::mt19937_64& random, unsigned bits) {
  Both both;
  while (bits > 0) {
    const unsigned some = std::min(bits, 60U);
    const auto digits = static_cast<std::int64_t>(random() >> (64 - some));
    both.whole = (both.whole << some) + digits;
    both.fixed <<= some;
    both.fixed += FixedInteger(digits);
    bits -= some;
  }
  if (random() % 2 == 0) both = {Integer(-both.whole), -both.fixed};
  return both;
}

TEST(FixedInteger, CountsAsWholeNumbersDo) {
  std::mt19937_64 random(1201);
  for (int i = 0; i < 20000; ++i) {
    const Both a = random_number(random, random() % 191), b = random_number(random, random() % 191);
    EXPECT_EQ(a.fixed.whole_number(), a.whole);
    EXPECT_EQ((a.fixed + b.fixed).whole_number(), a.whole + b.whole);
    EXPECT_EQ((a.fixed - b.fixed).whole_number(), a.whole - b.whole);
    EXPECT_EQ((a.fixed * b.fixed).whole_number(), a.whole * b.whole);
    FixedInteger sum = b.fixed;
    sum.add_product(a.fixed, b.fixed);
    EXPECT_EQ(sum.whole_number(), b.whole + a.whole * b.whole);
    FixedInteger times = a.fixed;
    times *= -10LL;
    EXPECT_EQ(times.whole_number(), -10 * a.whole);
    ASSERT_FALSE(HasFailure()) << "seed 1201, case " << i;
  }
}

TEST(FixedInteger, WhatRunsOverOnTheWayDoesNotMatter) {
  std::mt19937_64 random(1202);
  for (int i = 0; i < 2000; ++i) {
    const Both a = random_number(random, 300), b = random_number(random, 300), c = random_number(random, 200);
    const FixedInteger large = a.fixed * b.fixed;  // 600 bits, which overflow
    EXPECT_EQ((large + c.fixed - large).whole_number(), c.whole);
  }
}

TEST(FixedInteger, ShiftsByAnyNumberOfPlaces) {
  for (unsigned shift = 0; shift < 383; ++shift) {
    for (const std::int64_t x : {1, -1}) {
      FixedInteger shifted(x);
      shifted <<= shift;
      EXPECT_EQ(shifted.whole_number(), Integer(x) * (Integer(1) << shift));
    }
  }
}

}  // namespace
}  // namespace kds::fixed_integer_test
