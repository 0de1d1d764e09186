#include "certificates/conservative/interval.h"

#include <gtest/gtest.h>

#include "certificates/conservative/piece_view.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/rounds.h"

namespace kds::interval_test {
namespace {

using test::Random;

Rational rational(double x) { return Dyadic(x).rational(); }

bool holds(const Interval& interval, const Rational& x) {
  return (std::isinf(interval.lower) || rational(interval.lower) <= x) &&
         (std::isinf(interval.upper) || x <= rational(interval.upper));
}

double some_double(Random& random) {
  switch (random() % 6) {
    case 0:
      return test::pick(random, -2, 2);
    case 1:
      return std::ldexp(test::uniform(random), test::pick(random, -1074, -1000));
    case 2:
      return std::ldexp(test::uniform(random), test::pick(random, 500, 1024));
    default:
      return std::ldexp(test::uniform(random), test::pick(random, -30, 30));
  }
}

Interval some_interval(Random& random) {
  const double a = some_double(random);
  if (random() % 3 == 0) return Interval(a);
  const double b = some_double(random);
  return {std::min(a, b), std::max(a, b)};
}

TEST(Intervals, HoldTheResultsOfWhatTheyHold) {
  Random random(771);
  for (int i = 0; i < test::rounds(20000); ++i) {
    const Interval a = some_interval(random);
    const Interval b = some_interval(random);
    const auto some_of = [](const Interval& x) {
      return std::array{x.lower, x.upper, std::clamp(0.5 * x.lower + 0.5 * x.upper, x.lower, x.upper)};
    };
    const auto ends_a = some_of(a);
    const auto ends_b = some_of(b);
    for (const double p : ends_a) {
      const Rational x = rational(p);
      EXPECT_TRUE(holds(square(a), Rational(x * x)));
      EXPECT_TRUE(holds(-a, Rational(-x)));
      const Interval root = sqrt(a);
      if (p > 0 && !std::isinf(root.upper)) {
        EXPECT_TRUE(rational(root.lower) * rational(root.lower) <= x &&
                    x <= rational(root.upper) * rational(root.upper));
      }
      for (const double q : ends_b) {
        const Rational y = rational(q);
        EXPECT_TRUE(holds(a + b, Rational(x + y)));
        EXPECT_TRUE(holds(a - b, Rational(x - y)));
        EXPECT_TRUE(holds(a * b, Rational(x * y)));
        if (y != 0) {
          EXPECT_TRUE(holds(a / b, Rational(x / y)));
        }
        EXPECT_TRUE(holds(Interval::hull(a, b), x) && holds(Interval::hull(a, b), y));
      }
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Intervals, AreNoWiderThanTheyMustBe) {
  const Interval third = Interval(1) / Interval(3);
  EXPECT_LT(third.upper - third.lower, 0x1p-52);
  EXPECT_GT(third.upper, third.lower);
  EXPECT_EQ(square(Interval(-1, 2)).lower, 0);
  EXPECT_EQ(Interval::common({0, 2}, {1, 3}).lower, 1);
}

bool is_whole(const Interval& x) { return std::isinf(x.lower) && std::isinf(x.upper); }

TEST(Intervals, GiveUpOnTheWholeLine) {
  const Interval whole = Interval::whole();
  const double nan = std::nan("");
  EXPECT_TRUE(is_whole(Interval(1) / Interval(-1, 1)));
  EXPECT_TRUE(is_whole(Interval(1) / Interval(0)));
  EXPECT_TRUE(is_whole(sqrt(Interval(0, 1))));
  EXPECT_TRUE(is_whole(sqrt(Interval(-2, -1))));
  EXPECT_TRUE(is_whole(Interval(1e300) * Interval(1e300)));
  EXPECT_TRUE(is_whole(Interval(nan)));
  EXPECT_TRUE(is_whole(Interval(0, std::numeric_limits<double>::infinity())));
  for (const Interval& x :
       {Interval(0), Interval(1), Interval(-1), Interval(0, 1), Interval(-1, 0), Interval(-1, 1), whole}) {
    EXPECT_TRUE(is_whole(x * whole));
    EXPECT_TRUE(is_whole(whole * x));
    EXPECT_TRUE(is_whole(x + whole));
    EXPECT_TRUE(is_whole(whole - x));
    EXPECT_TRUE(is_whole(whole / x));
    EXPECT_TRUE(is_whole(x / whole));
  }
}

// An expression of every operation, over a piece of random curves, against its values at rational times.
TEST(MeanValues, HoldValuesAndDerivatives) {
  Random random(772);
  using M = BezierMotion<2, 3>;
  for (int i = 0; i < test::rounds(100); ++i) {
    SCOPED_TRACE("seed 772, round " + std::to_string(i));
    const auto motion = test::random_motion<M>(random, 2, test::MotionKind::generic);
    const int bits = test::pick(random, 0, 12);
    const double length = std::ldexp(1.0, -bits);
    const double lower = length * test::pick(random, 0, (1 << bits) - 1);
    const PieceView<M> view(motion, lower, lower + length);
    const auto [x, y] = view.difference(1, 0);
    const MeanValue r = view.radius(0);
    const MeanValue f = (square(x) * y - r) / (MeanValue(5) + x * y);
    const MeanValue g = sqrt(MeanValue(3) + f);
    const auto value = [&](const Rational& s) -> Rational {
      const Rational u = rational(lower) + s * rational(length);
      const Dyadic time(Integer(numerator(u)),
                        static_cast<unsigned>(mpz_sizeinbase(Integer(denominator(u)).data(), 2) - 1));
      const auto p = exact_position(motion, 1, time);
      const auto q = exact_position(motion, 0, time);
      const Rational a = p[0] - q[0];
      const Rational b = p[1] - q[1];
      return (a * a * b - exact_radius(motion, 0, time)) / (5 + a * b);
    };
    EXPECT_TRUE(holds(f.middle, value(Rational(1, 2))));
    for (int k = 0; k <= 16; ++k) {
      const Rational there = value(Rational(k, 16));
      EXPECT_TRUE(holds(f.range, there));
      EXPECT_TRUE(rational(g.range.lower) * rational(g.range.lower) <= 3 + there);
      EXPECT_TRUE(3 + there <= rational(g.range.upper) * rational(g.range.upper));
      if (k == 0) continue;
      EXPECT_TRUE(
          holds(f.slope, Rational(16 * (there - value(Rational(k - 1, 16))))));  // a mean of derivatives
    }
    // To first order: on a short piece the values' interval is hardly wider than they vary.
    if (bits >= 8) {
      EXPECT_LT(f.range.upper - f.range.lower, 2 * length * 100);
      EXPECT_LT(f.middle.upper - f.middle.lower, 1e-13);
    }
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace kds::interval_test
