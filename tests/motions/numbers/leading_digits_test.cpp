#include "motions/numbers/leading_digits.h"

#include <gtest/gtest.h>

#include "motions/numbers/fixed_digits.h"
#include "motions/numbers/long_digits.h"
#include "tests/support/inputs/random.h"

namespace kds::leading_digits_test {
namespace {

using test::pick;
using test::Random;

Rational power_of_two(std::int64_t exponent) {
  const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? fraction(1, power) : Rational(power);
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
    EXPECT_EQ(x.certain_sign(), sgn(exact));
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
    EXPECT_EQ(x.certain_sign(), sgn(exact));
  }
  if (x.is_zero()) {
    EXPECT_EQ(exact, 0);
  }
}

template <int Words>
void expect_encloses(const FixedDigits<Words>& x, const Rational& exact) {
  expect_encloses(x.long_digits(), exact);
  EXPECT_EQ(x.certain_sign(), x.long_digits().certain_sign());
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

// Compares sums and products of numbers of similar and very different sizes, with cancellation, with
// rationals (ball arithmetic).
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
      if (random() % 3 == 0) {  // almost the present sum with the opposite sign
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

template <int Words>
void expect_sums_of_products_enclosed(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    // Products of such different sizes that most lie below the last word of others, and some that cancel.
    FixedDigits<Words> sum;
    Rational exact = 0;
    for (int term = 0; term < 10; ++term) {
      Integer a = random_integer(random) << static_cast<unsigned>(pick(random, 0, 1500));
      Integer b = random_integer(random);
      add_product(sum, FixedDigits<Words>(a), FixedDigits<Words>(b));
      exact += Rational(Integer(a * b));
      if (random() % 2 != 0) continue;
      FixedDigits<Words> other(a);
      other <<= 3;
      add_product(sum, other, FixedDigits<Words>(Integer(-b)));
      exact -= Rational(Integer((a * b) << 3));
    }
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
    expect_encloses(sum, exact);
  }
}

template <int Words>
void expect_fixed_digits_right(std::uint64_t seed) {
  expect_expressions_enclosed<FixedDigits<Words>>(seed,
                                                  [](const Integer& x) { return FixedDigits<Words>(x); });
  expect_sums_of_products_enclosed<Words>(seed);
  Random random(seed);
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
    const Integer low = abs(random_integer(random)), high = low + abs(random_integer(random));
    const auto all = FixedDigits<Words>::between(low, high);
    for (const Integer& x : {low, high, Integer((low + high) / 2)}) expect_encloses(all, x);
    // Starts from longer digits, whose exponents are not multiples of 64.
    LongDigits longer(high, static_cast<std::size_t>(pick(random, 64, 3000)));
    const int power = pick(random, -500, 500);
    longer.scale(power);
    expect_encloses(FixedDigits<Words>(longer), Rational(high) * power_of_two(power));
    // The result keeps at least all words but one.
    const FixedDigits<Words> alone(high);
    EXPECT_TRUE(alone.long_digits().has_digits(64 * (Words - 1) - 1));
  }
}

TEST(FixedDigits, HoldsTheExactNumberWhateverTheWords) {
  expect_fixed_digits_right<4>(1105);
  expect_fixed_digits_right<8>(1106);
  expect_fixed_digits_right<16>(1107);
  expect_fixed_digits_right<32>(1108);
}

TEST(FixedDigits, KeepsWhatFits) {
  using Four = FixedDigits<4>;
  const Integer wide = (Integer(1) << 250) + 1;
  EXPECT_EQ(Four(wide).long_digits().number(), wide);
  EXPECT_TRUE((Four(wide) - Four(wide)).is_zero());
  EXPECT_TRUE(Four(Integer(5) << 1000).long_digits().has_digits(5000));
  EXPECT_FALSE(Four((Integer(5) << 1000) + 1).long_digits().has_digits(300));
  // All words are correct without cancellation, whatever lies far below.
  Four sum(Integer(1) << 1000);
  add_product(sum, Four(Integer(-3)), Four(Integer(1) << 100));
  EXPECT_TRUE(sum.long_digits().has_digits(190));
  EXPECT_EQ(sum.certain_sign(), 1);
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

TEST(LongDigits, GivesTheirLeadingDigits) {
  Random random(1109);
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Integer first = random_integer(random), second = random_integer(random);
    const auto bits = static_cast<std::size_t>(pick(random, 64, 2000));
    LongDigits x(first, bits);
    x *= LongDigits(second, bits);
    SCOPED_TRACE("case " + std::to_string(i));
    expect_encloses(x.leading_digits(), Rational(Integer(first * second)));
  }
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
}  // namespace kds::leading_digits_test
