#include "experiments/program/growth_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "experiments/program/power_fit.h"

namespace kds::growth_fit_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double four_thirds = 4.0 / 3;

// Returns 3.6 n^(4/3) - 4.9 n at nine sizes, times errors of this relative size.
GrowthPoints grid_family(double error = 0, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  GrowthPoints points;
  for (double n = 1000; n < 300'000; n *= 2)
    points.emplace_back(n, (3.6 * std::pow(n, four_thirds) - 4.9 * n) * (1 + error * normal(random)));
  return points;
}

TEST(GrowthFit, RecoversKnownCoefficients) {
  const auto fit = fit_growth(grid_family(), {{four_thirds}, {1}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->coefficients[0], 3.6, 1e-9);
  EXPECT_NEAR(fit->coefficients[1], -4.9, 1e-7);
  EXPECT_LT(fit->residual_most, 1e-12);
  EXPECT_NEAR(*fit->prediction_error, 0, 1e-11);
  EXPECT_NEAR(fit->at(8000), 3.6 * 160'000 - 4.9 * 8000, 1e-6);
  EXPECT_EQ(growth_text(*fit), "3.6 n^(4/3) - 4.9 n");
}

TEST(GrowthFit, ResidualsAndPredictionAsByHand) {
  // The least squares of a x / y - 1 over y = 1, 2, 3, 8 at x = 1, 2, 3, 4: a = (3 + 1/2) / (3 + 1/4).
  const auto fit = fit_growth({{1, 1}, {2, 2}, {3, 3}, {4, 8}}, {{1}});
  ASSERT_TRUE(fit);
  const double a = 3.5 / 3.25;
  EXPECT_NEAR(fit->coefficients[0], a, 1e-12);
  EXPECT_NEAR(fit->residual_most, 2 / a - 1, 1e-12);
  EXPECT_NEAR(*fit->prediction_error, 4.0 / 8 - 1, 1e-12);  // the other three lie on y = x
}

TEST(GrowthFit, TakesTheFormThatTheDataFollow) {
  for (const auto& form : usual_forms()) {
    GrowthPoints points;
    GrowthFit truth;
    truth.terms = form;
    truth.coefficients = {2, 30};
    truth.coefficients.resize(form.size());
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    for (double n = 64; n < 100'000; n *= 2)
      points.emplace_back(n, truth.at(n) * (1 + 0.001 * normal(random)));
    const auto best = best_growth(points, usual_forms());
    ASSERT_TRUE(best);
    EXPECT_EQ(best->terms.front().power, form.front().power) << growth_text(*best);
    EXPECT_EQ(best->terms.front().logarithm, form.front().logarithm) << growth_text(*best);
  }
}

TEST(GrowthFit, NeedsThreeSizesMoreThanTerms) {
  EXPECT_FALSE(fit_growth({{1, 1}, {2, 2}, {4, 4}}, {{1}}));
  EXPECT_TRUE(fit_growth({{1, 1}, {2, 2}, {4, 4}, {8, 8}}, {{1}}));
  EXPECT_FALSE(fit_growth({{1, 1}, {1, 2}, {2, 2}, {4, 4}}, {{1}}));                // three sizes
  EXPECT_FALSE(fit_growth({{1, 1}, {2, 0}, {4, 4}, {8, 8}}, {{1}}));                // a value of 0
  EXPECT_FALSE(fit_growth({{1, 8}, {2, 4}, {4, 2}, {8, 1}, {16, 1}}, {{2}, {0}}));  // it falls
}

// A power law without the lower-order term excludes the true exponent in every trial.
TEST(GrowthExponent, CoversTheTrueExponentAsOftenAsItClaims) {
  constexpr int trials = 500;
  int covered = 0, by_power = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const GrowthPoints points = grid_family(0.005, static_cast<std::uint64_t>(trial));
    const auto exponent = growth_exponent(points, {}, {{1}});
    ASSERT_TRUE(exponent);
    covered +=
        exponent->lower.value_or(1) <= four_thirds && four_thirds <= exponent->upper.value_or(3) ? 1 : 0;
    const auto power = fit_power(points);
    by_power += power->lower <= four_thirds && four_thirds <= power->upper ? 1 : 0;
  }
  EXPECT_GE(covered, trials * 0.925);
  EXPECT_LE(covered, trials * 0.99);
  EXPECT_EQ(by_power, 0);
}

TEST(GrowthExponent, ExactDataHaveAnExactExponent) {
  const auto exponent = growth_exponent(grid_family(), {}, {{1}});
  ASSERT_TRUE(exponent);
  EXPECT_NEAR(exponent->exponent, four_thirds, 1e-6);
  EXPECT_NEAR(exponent->lower.value(), four_thirds, 1e-5);
  EXPECT_NEAR(exponent->upper.value(), four_thirds, 1e-5);
}

// Data that grow as n log n cannot be told from a power slightly above the linear term.
TEST(GrowthExponent, IsOpenWhereTheLowerTermBegins) {
  GrowthPoints points;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (double n = 1000; n < 300'000; n *= 2)
    points.emplace_back(n, n * std::log2(n) * (1 + 0.02 * normal(random)));
  const auto exponent = growth_exponent(points, {}, {{1}});
  ASSERT_TRUE(exponent);
  EXPECT_FALSE(exponent->lower);
  ASSERT_TRUE(exponent->upper);
  EXPECT_LT(*exponent->upper, 1.3);
  EXPECT_THAT(exponent_text(*exponent), HasSubstr("(95%: below "));
  EXPECT_FALSE(growth_exponent({points.begin(), points.begin() + 4}, {}, {{1}}));
}

TEST(LocalExponents, AreSlopesBetweenSizes) {
  const GrowthPoints points{{4, 20}, {1, 1}, {2, 3}, {2, 5}};
  EXPECT_THAT(one_per_size(points),
              ElementsAre(std::pair(1.0, 1.0), std::pair(2.0, 4.0), std::pair(4.0, 20.0)));
  EXPECT_THAT(local_exponents(points), ElementsAre(2, testing::DoubleNear(std::log2(5), 1e-12)));
}

}  // namespace
}  // namespace kds::growth_fit_test
