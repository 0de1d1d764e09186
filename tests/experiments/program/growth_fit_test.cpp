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

// On average the exponent beside the lower-order term is right. The power law alone is too steep.
TEST(GrowthExponent, IsNotBiasedByTheLowerOrderTerm) {
  constexpr int trials = 200;
  double mean = 0, by_power = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const GrowthPoints points = grid_family(0.005, static_cast<std::uint64_t>(trial));
    mean += growth_exponent(points, {}, {{1}}).value() / trials;
    by_power += fit_power(points)->exponent / trials;
  }
  EXPECT_NEAR(mean, four_thirds, 0.005);
  EXPECT_GT(by_power, four_thirds + 0.02);
}

TEST(GrowthExponent, ExactDataHaveAnExactExponent) {
  EXPECT_NEAR(growth_exponent(grid_family(), {}, {{1}}).value(), four_thirds, 1e-6);
  const GrowthPoints points = grid_family();
  EXPECT_FALSE(growth_exponent({points.begin(), points.begin() + 4}, {}, {{1}}));
  EXPECT_TRUE(growth_exponent({points.begin(), points.begin() + 5}, {}, {{1}}));
}

TEST(LocalExponents, AreSlopesBetweenSizes) {
  const GrowthPoints points{{4, 20}, {1, 1}, {2, 3}, {2, 5}};
  EXPECT_THAT(one_per_size(points),
              ElementsAre(std::pair(1.0, 1.0), std::pair(2.0, 4.0), std::pair(4.0, 20.0)));
  EXPECT_THAT(local_exponents(points), ElementsAre(2, testing::DoubleNear(std::log2(5), 1e-12)));
}

}  // namespace
}  // namespace kds::growth_fit_test
