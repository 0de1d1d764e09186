#include "motions/numbers/rounding_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "motions/numbers/exact_number.h"

namespace kds::magnitude_test {
namespace {

// A number in floating point, exactly, and as a magnitude for inputs whose differences are at most `size`.
template <class Rounded>
struct Followed {
  Rounded rounded;
  Rational exact;
  MagnitudeIn<std::numeric_limits<Rounded>::digits> magnitude;
};

template <class Rounded>
class MagnitudesTest : public testing::Test {
 protected:
  Followed<Rounded> input(double size) {
    std::uniform_real_distribution<double> near(-size / 2, size / 2);
    const double a = near(random_);
    const double b = near(random_);
    return {static_cast<Rounded>(a - b), Rational(a) - Rational(b),
            decltype(Followed<Rounded>::magnitude)::input_difference(1)};
  }

  static void expect_bounded(const Followed<Rounded>& x, double size) {
    Rational scale = 1;
    for (int i = 0; i < x.magnitude.power; ++i) scale *= Rational(size);
    EXPECT_LE(abs(Rational(double{x.rounded}) - x.exact),
              Rational(x.magnitude.error) * scale * (1 + Rational(0x1p-30)));
    EXPECT_LE(abs(x.exact), Rational(x.magnitude.bound) * scale * (1 + Rational(0x1p-30)));
  }

  std::mt19937_64 random_{21};
};

template <class R>
Followed<R> operator+(const Followed<R>& a, const Followed<R>& b) {
  return {a.rounded + b.rounded, a.exact + b.exact, a.magnitude + b.magnitude};
}
template <class R>
Followed<R> operator-(const Followed<R>& a, const Followed<R>& b) {
  return {a.rounded - b.rounded, a.exact - b.exact, a.magnitude - b.magnitude};
}
template <class R>
Followed<R> operator*(const Followed<R>& a, const Followed<R>& b) {
  return {a.rounded * b.rounded, a.exact * b.exact, a.magnitude * b.magnitude};
}

using Roundings = testing::Types<double, float>;
TYPED_TEST_SUITE(MagnitudesTest, Roundings);

TYPED_TEST(MagnitudesTest, BoundTheErrorOfADeterminant) {
  double largest_share = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::ldexp(1.0, sizeof(TypeParam) == 8 ? i % 200 - 100 : i % 40 - 20);
    const auto a = this->input(size);
    const auto b = this->input(size);
    const auto c = this->input(size);
    const auto d = this->input(size);
    for (const auto& x : {a * d - b * c, (a + b) * (c - d), a * b * c + d * d * (a - c)}) {
      this->expect_bounded(x, size);
      const Rational off = abs(Rational(double{x.rounded}) - x.exact);
      largest_share =
          std::max(largest_share, off.get_d() / (x.magnitude.error * std::pow(size, x.magnitude.power)));
    }
  }
  EXPECT_GT(largest_share, 0.1);  // the bound is not exaggerated
}

TEST(MagnitudeTest, ConstantsAreExact) {
  const Magnitude three = Magnitude::constant(-3);
  EXPECT_EQ(three.bound, 3);
  EXPECT_EQ(three.error, 0);
  EXPECT_EQ(three.power, 0);
  const Magnitude product = three * Magnitude::input_difference(2);
  EXPECT_EQ(product.power, 2);
  // The error includes the rounding of the product itself.
  EXPECT_GT(product.error, 3 * Magnitude::input_difference(2).error);
}

TEST(MagnitudeTest, UnlikePowersAreRefused) {
  EXPECT_THROW((void)(Magnitude::input_difference(1) + Magnitude::input_difference(2)), std::logic_error);
  EXPECT_EQ((Magnitude{} + Magnitude::input_difference(2)).power, 2);  // zero is compatible with any power
  EXPECT_EQ((Magnitude::input_difference(2) - Magnitude{}).power, 2);
}

}  // namespace
}  // namespace kds::magnitude_test
