// Tests times as listeners receive them: canonical brackets, and twelve digits, correctly rounded.

#include "kds/event.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "tests/support/inputs/polynomial_source.h"
#include "tests/support/inputs/random.h"
#include "tests/support/rounds.h"

namespace kds::rounded_time_test {
namespace {

using namespace test;

constexpr FrameStamp step_begin{0, {}}, step_end{1, {}};

/// The root of a function, with a bracket that contains it.
class Root {
 public:
  Root(Scaled function, double lower, double upper)
      : slot_(source_.add(std::move(function), named(1))), now_(FailureTime{lower, upper}, source_, slot_) {}

  [[nodiscard]] const Instant& now() const { return now_; }
  [[nodiscard]] double frame() const { return rounded_time(now_, step_begin, step_end).frame; }
  [[nodiscard]] std::string printed() const { return fmt::format("{:.12g}", frame()); }
  [[nodiscard]] double picoseconds(double from, double to) const {
    return rounded_time(now_, {0, from}, {1, to}).picoseconds.value();
  }

 private:
  PolynomialSource source_;
  std::uint32_t slot_;
  Instant now_;
};

Integer power_of_ten(unsigned long exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, exponent);
  return power;
}

/// Returns a function with the root p 10^-places + sign 10^-more.
Scaled near(std::int64_t p, unsigned long digits, unsigned long more, int sign) {
  return linear(Integer(p) * power_of_ten(more - digits) + Integer(sign), power_of_ten(more));
}

TEST(RoundedTime, IsNarrowedUntilTwelveDigitsAreCertain) {
  const Root root(falling_at_root_of_one_over(2), 0.5, 0.9);
  EXPECT_EQ(root.printed(), "0.707106781187");
  EXPECT_EQ(root.now().lower(), 0.5);  // printing does not change the bracket
  EXPECT_EQ(root.now().upper(), 0.9);
  EXPECT_EQ(rounded_time(root.now(), {1000, {}}, {1010, {}}).frame, 1007.07106781);
  EXPECT_FALSE(rounded_time(root.now(), {1000, {}}, {1010, {}}).picoseconds);
  EXPECT_EQ(root.picoseconds(-1, 1), 0.414213562373);
  EXPECT_EQ(root.picoseconds(1, -1), -0.414213562373);
  EXPECT_EQ(root.picoseconds(0, 1e300), 7.07106781187e299);
  EXPECT_EQ(root.picoseconds(5, 5), 5);
}

TEST(RoundedTime, ExactTimesAreRecognised) {
  EXPECT_EQ(Root(falling(1, 2), 0.25, 0.875).printed(), "0.5");
  EXPECT_EQ(Root(falling(1, 3), 0.25, 0.5).printed(), "0.333333333333");
  EXPECT_EQ(Root(falling(515, 1000), 0.25, 0.875).printed(), "0.515");
  EXPECT_EQ(Root(falling(1, 3), 0.25, 0.5).picoseconds(-1, 2), 0.0);
  EXPECT_EQ(Root(falling(1, 3), 0.25, 0.5).picoseconds(2, -1), 1.0);
}

// Half a unit of the last digit that no double represents: rounds to the even digit, as for doubles that are
// ties.
TEST(RoundedTime, TiesOfTheRoundingEnd) {
  EXPECT_EQ(Root(near(1234567890125, 13, 13, 0), 0.1, 0.2).printed(), "0.123456789012");
  EXPECT_EQ(Root(near(1234567890135, 13, 13, 0), 0.1, 0.2).printed(), "0.123456789014");
  EXPECT_EQ(Root(near(9999999999995, 13, 13, 0), 0.9, 1).printed(), "1");
  for (const unsigned long digits : {30UL, 100UL, 400UL}) {
    EXPECT_EQ(Root(near(1234567890125, 13, digits, -1), 0.1, 0.2).printed(), "0.123456789012");
    EXPECT_EQ(Root(near(1234567890125, 13, digits, 1), 0.1, 0.2).printed(), "0.123456789013");
    EXPECT_EQ(Root(near(9999999999995, 13, digits, -1), 0.9, 1).printed(), "0.999999999999");
    EXPECT_EQ(Root(near(9999999999995, 13, digits, 1), 0.9, 1).printed(), "1");
  }
}

TEST(RoundedTime, SmallTimesHaveTwelveDigitsToo) {
  EXPECT_EQ(Root(linear(1, 3 * power_of_ten(20)), 0, 0.5).printed(), "3.33333333333e-21");
  EXPECT_EQ(Root(linear(1, 3 * power_of_ten(200)), 0, 1).printed(), "3.33333333333e-201");
  EXPECT_EQ(Root(linear(power_of_ten(20) + Integer(2), 2 * power_of_ten(20)), 0.25, 0.75).picoseconds(-1, 1),
            2e-20);
}

TEST(RoundedTime, ABracketAloneHasTheDigitsOfBothEnds) {
  const auto frame = [](double lower, double upper, std::size_t from) {
    return rounded_time(Instant(FailureTime{lower, upper}), {from, {}}, {from + 1, {}}).frame;
  };
  EXPECT_EQ(frame(0.25, 0.25, 3), 3.25);
  EXPECT_EQ(frame(0.1234567, 0.1234568, 0), 0.123457);
  EXPECT_EQ(frame(0.1234567, 0.1234568, 30), 30.123457);
  EXPECT_EQ(frame(0.1, 0.2, 30), 30);
}

// The judge uses rational numbers: the error is at most half a unit of the twelfth digit.
TEST(RoundedTime, IsTheNearestNumberOfTwelveDigits) {
  Random random(34);
  for (int round = 0; round < rounds(2000); ++round) {
    const int q = pick(random, 3, 1'000'000), p = pick(random, 1, q - 1);
    const double root = static_cast<double>(p) / q, reach = std::ldexp(1.0, -pick(random, 1, 50));
    const Root time(linear(p, q), std::max(0.0, root - reach), std::min(1.0, root + reach));
    const double from = pick(random, -1000, 1000) * std::ldexp(1.0, -pick(random, 0, 9));
    const double to = from + pick(random, -99, 99);
    const Rational exact =
        Rational(from) + (Rational(to) - Rational(from)) * fraction(Integer(p), Integer(q));
    const std::string printed = fmt::format("{:.11e}", time.picoseconds(from, to));
    const std::size_t e = printed.find('e');
    std::string digits = printed.substr(0, e);
    digits.erase(digits.find('.'), 1);
    const int exponent = std::stoi(printed.substr(e + 1)) - 11;
    const Rational unit = exponent < 0
                              ? Rational(1) / Rational(power_of_ten(static_cast<unsigned long>(-exponent)))
                              : Rational(power_of_ten(static_cast<unsigned long>(exponent)));
    const Rational off = abs(Rational(Integer(digits)) * unit - exact);
    if (sgn(exact) == 0) {
      EXPECT_EQ(sgn(off), 0);
    } else {
      EXPECT_LE(off * Rational(2), unit) << p << '/' << q << " from " << from << " to " << to;
    }
  }
}

/// Returns the canonical bracket of a rational time, computed by its definition.
TimeBracket bracket_of(const Rational& time, unsigned bits) {
  const double cell = std::ldexp(1.0, -static_cast<int>(bits));
  const Rational scaled = time / Rational(cell);
  Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  const double lower = whole.get_d() * cell;
  return {lower, Rational(whole) == scaled ? lower : lower + cell};
}

TEST(CanonicalBracket, IsDefinedByTheTimeAlone) {
  const Rational grid(0x1p-24), tiny = fraction(Integer(1), power_of_ten(300));
  std::vector<Rational> times{
      Rational(1, 2), Rational(1, 3), Rational(1, 256), Rational(255, 256), Rational(2, 7),
      tiny,           grid,           1 - grid,         1 - grid * tiny,    grid / 2,
      grid * 3 / 2,   Rational(0.1),  Rational(0x1p-50)};
  for (const Rational& on_grid : {Rational(1, 2), Rational(5, 256), Rational(0.75 + 0x1p-24)})
    for (const Rational& off : {tiny, Rational(grid / 1024), Rational(0x1p-44), Rational(0x1p-52)})
      for (const int sign : {-1, 1}) times.emplace_back(on_grid + sign * off);
  Random random(49);
  for (const Rational& time : times) {
    const Scaled function = linear(numerator(time), denominator(time));
    for (int round = 0; round < rounds(40, 10); ++round) {
      // A bracket as a search may find it: the time lies strictly between its ends.
      const double reach = round == 0 ? 1 : std::ldexp(1.0, -pick(random, 1, 60));
      double lower = std::max(0.0, time.get_d() - reach), upper = std::min(1.0, time.get_d() + reach);
      while (!(Rational(lower) < time)) lower = std::nextafter(lower, -1);
      while (!(time < Rational(upper))) upper = std::nextafter(upper, 2);
      if (lower < 0 || upper > 1) continue;
      const Root root(function, lower, upper);
      for (const unsigned bits : {8U, event_bits, 44U})
        EXPECT_EQ(canonical_bracket(root.now(), bits), bracket_of(time, bits)) << lower << ' ' << upper;
      EXPECT_EQ(root.now().lower(), lower);
      EXPECT_EQ(root.now().upper(), upper);
    }
    const double u = time.get_d();
    if (Rational(u) == time) {
      EXPECT_EQ(canonical_bracket(Instant(u)), bracket_of(time, event_bits)) << u;
    }
  }
  EXPECT_EQ(canonical_bracket(Instant(0)), (TimeBracket{0, 0}));
  EXPECT_EQ(canonical_bracket(Instant(Dyadic(1, 400))), (TimeBracket{0, 0x1p-24}));
}

TEST(CanonicalBracket, ChoosesAmongManyRoots) {
  // (3u - 1) (2u - 1) (3u - 2)^2, whose last root is a touch, all in one bracket
  const Scaled function = product(product(linear(1, 3), linear(1, 2)), product(linear(2, 3), linear(2, 3)));
  PolynomialSource source;
  const std::uint32_t slot = source.add(function, named(1));
  const Rational roots[] = {Rational(1, 3), Rational(1, 2), Rational(2, 3)};
  for (std::uint16_t k = 0; k < 3; ++k)
    for (const double reach : {0.0, 0.1, 0.2})
      EXPECT_EQ(canonical_bracket(Instant(FailureTime{reach, 1 - reach, k, false}, source, slot)),
                bracket_of(roots[k], event_bits));
}

// A replayed time has no function. If the grid cuts its bracket, the bracket stays as the log has it.
TEST(CanonicalBracket, OfAReplayedTimeIsItsOwn) {
  for (const auto& [lower, upper] : {std::pair(0.25, 0.75), {0.25, 0.25}, {0.25, 0.25 + 0x1p-24}})
    EXPECT_EQ(canonical_bracket(Instant(FailureTime{lower, upper, 0, false})), (TimeBracket{lower, upper}));
}

}  // namespace
}  // namespace kds::rounded_time_test
