#include "motions/numbers/rounding_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motions/numbers/exact_number.h"

namespace kds::tracked_double_test {
namespace {

struct Followed {
  TrackedDouble tracked;
  Rational exact;
};

Followed operator+(const Followed& a, const Followed& b) {
  return {a.tracked + b.tracked, a.exact + b.exact};
}
Followed operator-(const Followed& a, const Followed& b) {
  return {a.tracked - b.tracked, a.exact - b.exact};
}
Followed operator*(const Followed& a, const Followed& b) {
  return {a.tracked * b.tracked, a.exact * b.exact};
}

Followed input(std::mt19937_64& random, int lowest, int highest) {
  const double x = std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random),
                              std::uniform_int_distribution<int>(lowest, highest)(random));
  return {{x, 0}, Rational(x)};
}

void expect_enclosed(const Followed& x) {
  if (!std::isfinite(x.tracked.error) || !std::isfinite(x.tracked.value)) return;  // nothing is claimed
  EXPECT_LE(abs(Rational(x.tracked.value) - x.exact),
            Rational(x.tracked.error) * Rational(TrackedDouble::inflation));
}

void expect_enclosures(int lowest, int highest) {
  std::mt19937_64 random(31);
  for (int i = 0; i < 3000; ++i) {
    const Followed a = input(random, lowest, highest);
    const Followed b = input(random, lowest, highest);
    const Followed c = input(random, lowest, highest);
    const Followed d = input(random, lowest, highest);
    expect_enclosed(a + b);
    expect_enclosed(a * b);
    expect_enclosed((a + b) * (c - d) - (a - c) * (b + d));
    expect_enclosed(a * b * c * d - (d * c) * (b * a));
    const Followed difference = a * d - b * c;
    expect_enclosed(difference * difference - difference * a + d);
  }
}

TEST(TrackedDouble, EnclosesTheExactValue) { expect_enclosures(-5, 5); }
TEST(TrackedDouble, EnclosesAcrossScales) { expect_enclosures(-200, 200); }
TEST(TrackedDouble, EnclosesWhatUnderflows) { expect_enclosures(-540, -500); }
TEST(TrackedDouble, EnclosesSubnormals) { expect_enclosures(-1074, -1000); }
TEST(TrackedDouble, EnclosesOrSaysNothingWhereItOverflows) { expect_enclosures(400, 600); }

TEST(TrackedDouble, OverflowIsNotLost) {
  const TrackedDouble large{0x1p600, 0};
  const TrackedDouble product = large * large;
  EXPECT_FALSE(std::isfinite(product.error));
  EXPECT_FALSE((product - product).error <= 1);
}

TEST(TrackedDouble, IsSharpWhereNumbersAreOfUnlikeSize) {
  const TrackedDouble small = TrackedDouble{0x1p-60, 0} + TrackedDouble{0x1p-61, 0};
  EXPECT_LE(small.error, 0x1p-110);
}

}  // namespace
}  // namespace kds::tracked_double_test
