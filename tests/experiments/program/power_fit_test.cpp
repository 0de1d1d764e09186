#include "experiments/program/power_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace kds::power_fit_test {
namespace {

using Points = std::vector<std::pair<double, double>>;

TEST(PowerFit, FindsThePowerThatPointsFollow) {
  Points points;
  for (const double x : {1000.0, 3000.0, 10000.0, 50000.0}) points.emplace_back(x, 3 * std::pow(x, 1.4));
  const auto fit = fit_power(points);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->points, 4U);
  EXPECT_NEAR(fit->exponent, 1.4, 1e-12);
  EXPECT_NEAR(fit->factor, 3, 1e-9);
  EXPECT_FALSE(fit->error);
}

// y = 1, 2, 2, 4 at x = 1, 2, 4, 8. By hand: slope 0.6.
TEST(PowerFit, SlopeAsByHand) {
  const auto fit = fit_power(Points{{1, 1}, {2, 2}, {4, 2}, {8, 4}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->exponent, 0.6, 1e-12);
  EXPECT_EQ(exponent_text(*fit), "0.600");
}

TEST(PowerFit, WhatHasNoLogarithmIsLeftOut) {
  const Points points{{1, 2}, {0, 5}, {2, 4}, {3, 0}, {-1, 1}, {4, 8}};
  const auto fit = fit_power(points);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->points, 3U);
  EXPECT_EQ(fit->left_out, 3U);
  EXPECT_NEAR(fit->exponent, 1, 1e-12);
  EXPECT_EQ(exponent_text(*fit), "1.000 (3 of 6 points are 0 and left out)");
  EXPECT_EQ(exponent_text(PowerFit{3, 1, 1.5, 1, 0.25}),
            "1.500 (95%: 1.250 to 1.750; 1 of 4 points are 0 and left out)");
}

// The exponents without one or the other share are 1 and 2, so the jackknife error is half their difference.
// The t quantile with one degree of freedom is tan(pi (p - 1/2)).
TEST(PowerFit, IntervalOfSharesAsByHand) {
  const Points points{{1, 1}, {2, 3}, {4, 8}};
  const std::vector<Points> without{{{1, 1}, {2, 2}, {4, 4}}, {{1, 1}, {2, 4}, {4, 16}}};
  const auto fit = fit_power(points, without);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->exponent, 1.5, 1e-12);
  EXPECT_NEAR(fit->error.value(), std::tan(std::numbers::pi * 0.475) * 0.5, 1e-9);
  EXPECT_FALSE(fit_power(points, std::vector<Points>{without[0]}));
  EXPECT_FALSE(fit_power(points, std::vector<Points>{without[0], {{1, 1}, {2, 0}, {4, 16}}}));
}

TEST(PowerFit, NoneOfTwoPointsOrOfOneX) {
  EXPECT_FALSE(fit_power(Points{{1, 1}, {2, 2}}));
  EXPECT_FALSE(fit_power(Points{{2, 1}, {2, 2}, {2, 3}}));
}

}  // namespace
}  // namespace kds::power_fit_test
