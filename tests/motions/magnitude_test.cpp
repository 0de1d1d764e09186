#include "motions/magnitude.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motions/exact_number.h"

namespace kds {
namespace {

// A number in double, exactly, and as a magnitude for inputs at most `size` apart.
struct Followed {
  double rounded;
  Rational exact;
  Magnitude magnitude;
};

class MagnitudeTest : public testing::Test {
 protected:
  Followed input(double size) {
    std::uniform_real_distribution<double> near(-size / 2, size / 2);
    const double a = near(random_);
    const double b = near(random_);
    return {a - b, Rational(a) - Rational(b), Magnitude::input_difference(1)};
  }

  static void expect_bounded(const Followed& x, double size) {
    Rational scale = 1;
    for (int i = 0; i < x.magnitude.power; ++i) scale *= Rational(size);
    EXPECT_LE(abs(Rational(x.rounded) - x.exact),
              Rational(x.magnitude.error) * scale * (1 + Rational(0x1p-30)));
    EXPECT_LE(abs(x.exact), Rational(x.magnitude.bound) * scale * (1 + Rational(0x1p-30)));
  }

  std::mt19937_64 random_{21};
};

Followed operator+(const Followed& a, const Followed& b) {
  return {a.rounded + b.rounded, a.exact + b.exact, a.magnitude + b.magnitude};
}
Followed operator-(const Followed& a, const Followed& b) {
  return {a.rounded - b.rounded, a.exact - b.exact, a.magnitude - b.magnitude};
}
Followed operator*(const Followed& a, const Followed& b) {
  return {a.rounded * b.rounded, a.exact * b.exact, a.magnitude * b.magnitude};
}

TEST_F(MagnitudeTest, BoundsTheErrorOfADeterminant) {
  double largest_share = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::ldexp(1.0, i % 200 - 100);
    const Followed a = input(size);
    const Followed b = input(size);
    const Followed c = input(size);
    const Followed d = input(size);
    for (const Followed& x : {a * d - b * c, (a + b) * (c - d), a * b * c + d * d * (a - c)}) {
      expect_bounded(x, size);
      const double unit = std::pow(size, x.magnitude.power);
      largest_share = std::max(largest_share, std::abs((Rational(x.rounded) - x.exact).convert_to<double>()) /
                                                  (x.magnitude.error * unit));
    }
  }
  EXPECT_GT(largest_share, 0.1);  // the bound is no exaggeration
}

TEST_F(MagnitudeTest, ConstantsAreExact) {
  const Magnitude three = Magnitude::constant(-3);
  EXPECT_EQ(three.bound, 3);
  EXPECT_EQ(three.error, 0);
  EXPECT_EQ(three.power, 0);
  const Magnitude product = three * Magnitude::input_difference(2);
  EXPECT_EQ(product.power, 2);
  EXPECT_GT(product.error, 3 * Magnitude::input_difference(2).error);  // its own rounding
}

TEST_F(MagnitudeTest, UnlikePowersAreRefused) {
  EXPECT_THROW((void)(Magnitude::input_difference(1) + Magnitude::input_difference(2)), std::logic_error);
  EXPECT_EQ((Magnitude{} + Magnitude::input_difference(2)).power, 2);  // zero is of any power
  EXPECT_EQ((Magnitude::input_difference(2) - Magnitude{}).power, 2);
}

}  // namespace
}  // namespace kds
