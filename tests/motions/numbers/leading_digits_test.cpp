#include "motions/numbers/leading_digits.h"

#include <gtest/gtest.h>

#include <random>

#include "motions/numbers/long_digits.h"

namespace kds {
namespace {

using Random = std::mt19937_64;

int pick(Random& random, int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }

Rational power_of_two(std::int64_t exponent) {
  const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(1, power) : Rational(power);
}

Integer magnitude_of(const LeadingDigits& x) {
  Integer high = static_cast<std::uint64_t>(x.magnitude >> 64U);
  return (high << 64U) + static_cast<std::uint64_t>(x.magnitude);
}

void expect_encloses(const LeadingDigits& x, const Rational& exact) {
  const Integer signed_value = x.negative ? Integer(-magnitude_of(x)) : magnitude_of(x);
  const Rational off = abs(Rational(exact / power_of_two(x.exponent) - signed_value));
  EXPECT_LE(off, Rational(Integer(x.error)));
  EXPECT_LT(magnitude_of(x), Integer(1) << LeadingDigits::most_bits);
  if (x.certain_sign() != 0) {
    EXPECT_EQ(x.certain_sign(), exact.sign());
  }
  if (x.is_zero()) {
    EXPECT_EQ(exact, 0);
  }
  if (exact != 0) {
    EXPECT_LT(abs(exact), power_of_two(x.top_bit()));
  }
}

void expect_encloses(const LongDigits& x, const Rational& exact) {
  const Rational off = abs(Rational(exact / power_of_two(x.exponent()) - x.number()));
  EXPECT_LE(off, Rational(Integer(x.error())));
  if (x.certain_sign() != 0) {
    EXPECT_EQ(x.certain_sign(), exact.sign());
  }
  if (x.is_zero()) {
    EXPECT_EQ(exact, 0);
  }
}

Integer random_integer(Random& random) {
  Integer x = static_cast<std::int64_t>(random()) >> pick(random, 0, 62);
  if (random() % 3 == 0)
    x = (x << static_cast<unsigned>(pick(random, 0, 400))) + static_cast<std::int64_t>(random());
  return x << static_cast<unsigned>(random() % 2 == 0 ? 0 : pick(random, 0, 900));
}

// Sums and products of numbers near and far, with what cancels: beside rationals.
template <class Number, class Make>
void expect_expressions_enclosed(std::uint64_t seed, const Make& make) {
  Random random(seed);
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Integer first = random_integer(random);
    Number x = make(first);
    Rational exact = first;
    for (int step = 0; step < 12; ++step) {
      const Integer next = random_integer(random);
      Number y = make(next);
      Rational other = next;
      if (random() % 3 == 0) {  // nearly what there is, with the other sign
        y = x;
        y *= make(Integer(-1));
        other = -exact;
        y += make(next);
        other += next;
      }
      if (random() % 2 == 0) {
        x += y;
        exact += other;
      } else {
        x *= y;
        exact *= other;
      }
      SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
      expect_encloses(x, exact);
    }
  }
}

TEST(LeadingDigits, HoldsTheExactNumber) {
  expect_expressions_enclosed<LeadingDigits>(1101, [](const Integer& x) { return LeadingDigits::of(x); });
}

TEST(LongDigits, HoldsTheExactNumberWhateverTheBits) {
  for (const std::size_t bits : {64U, 126U, 300U, 2000U}) {
    expect_expressions_enclosed<LongDigits>(1102 + bits,
                                            [&](const Integer& x) { return LongDigits(x, bits); });
  }
  expect_expressions_enclosed<LongDigits>(
      1103, [](const Integer& x) { return LongDigits(x, LongDigits::unlimited); });
}

TEST(LongDigits, HoldsAllNumbersBetweenTwo) {
  Random random(1104);
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Integer low = abs(random_integer(random)), high = low + abs(random_integer(random));
    const std::size_t bits = random() % 3 == 0 ? LongDigits::unlimited : 1U << (6 + random() % 6);
    const LongDigits all = LongDigits::between(low, high, bits);
    SCOPED_TRACE("seed 1104, case " + std::to_string(i));
    for (const Integer& x : {low, high, Integer((low + high) / 2)}) expect_encloses(all, x);
    EXPECT_LT(all.error(), std::uint64_t{1} << 61U);
    if (low == high && bits == LongDigits::unlimited) {
      EXPECT_LE(all.error(), 1U);
    }
  }
}

TEST(LongDigits, IsExactWithoutALimit) {
  LongDigits x(Integer(3), LongDigits::unlimited);
  x *= LongDigits(Integer(1) << 5000, LongDigits::unlimited);
  x += LongDigits(Integer(-1), LongDigits::unlimited);
  EXPECT_EQ(x.error(), 0U);
  EXPECT_EQ(x.number(), (Integer(3) << 5000) - 1);
  EXPECT_TRUE(x.has_digits(6000));
}

TEST(LeadingDigits, KeepsWhatFits) {
  const Integer wide = (Integer(1) << 125) + 1;
  EXPECT_EQ(magnitude_of(LeadingDigits::of(wide)), wide);
  EXPECT_EQ(LeadingDigits::of(wide).error, 0U);
  EXPECT_EQ(LeadingDigits::of(Integer(5) << 1000).error, 0U);
  EXPECT_EQ(LeadingDigits::of((Integer(5) << 1000) + 1).error, 1U);
  EXPECT_TRUE((LeadingDigits::of(wide) - LeadingDigits::of(wide)).is_zero());
}

}  // namespace
}  // namespace kds
