#include "experiments/program/mean_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace kds::mean_interval_test {
namespace {

// The t quantile with one degree of freedom is tan(pi (p - 1/2)).
TEST(MeanOfIndependent, IntervalAsByHand) {
  const auto mean = mean_of_independent(std::vector<double>{1, 3});
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->mean, 2);
  EXPECT_NEAR(mean->upper - 2, std::tan(std::numbers::pi * 0.475) * 1, 1e-9);
  EXPECT_NEAR(2 - mean->lower, mean->upper - 2, 1e-12);
  EXPECT_EQ(interval_text({2, 1, 3, 2}), "2.000 (95%: 1.000 to 3.000)");
  EXPECT_FALSE(mean_of_independent(std::vector<double>{1}));
}

TEST(AboveZero, KeepsTheMeanAndStaysAboveZero) {
  const auto plain = mean_of_independent(std::vector<double>{1, 3});
  ASSERT_LT(plain->lower, 0);
  const auto above = above_zero(plain);
  ASSERT_TRUE(above);
  EXPECT_EQ(above->mean, 2);
  EXPECT_GT(above->lower, 0);
  EXPECT_NEAR(std::log(above->upper / 2), (plain->upper - 2) / 2, 1e-12);
  EXPECT_NEAR(above->lower * above->upper, 4, 1e-12);  // symmetric for the logarithm
  const auto narrow = above_zero(MeanInterval{100, 99, 101, 9});
  EXPECT_NEAR(narrow->lower, 99, 0.01);
  EXPECT_NEAR(narrow->upper, 101, 0.01);
  EXPECT_FALSE(above_zero(std::nullopt));
  EXPECT_FALSE(above_zero(mean_of_independent(std::vector<double>{2, 2})));  // no spread
  EXPECT_FALSE(above_zero(MeanInterval{0, -1, 1, 3}));
  EXPECT_FALSE(above_zero(MeanInterval{1, -9999, 10001, 2}));  // no finite end
}

// Log-normal values, as of inputs whose rates differ by factors, and 95% intervals of their mean.
TEST(AboveZero, CoversMeansOfFewSkewedValuesMoreOften) {
  constexpr double sigma = 0.7;
  constexpr int trials = 4000;
  const double mean = std::exp(sigma * sigma / 2);
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0, sigma);
  for (const std::size_t count : {2U, 4U, 8U}) {
    int plain_covers = 0, covers = 0;
    for (int trial = 0; trial < trials; ++trial) {
      std::vector<double> values;
      for (std::size_t k = 0; k < count; ++k) values.push_back(std::exp(normal(random)));
      const auto plain = mean_of_independent(values), above = above_zero(plain);
      plain_covers += plain->lower <= mean && mean <= plain->upper ? 1 : 0;
      covers += above->lower <= mean && mean <= above->upper ? 1 : 0;
    }
    EXPECT_GT(covers, plain_covers) << count;
    EXPECT_GT(covers, 0.9 * trials) << count;
    EXPECT_LT(covers, 0.97 * trials) << count;
  }
}

// Returns an autoregressive process of order 1 with mean 3. Its integrated correlation time is
// (1 + memory) / (1 - memory).
std::vector<double> process(double memory, std::size_t count, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double off = normal(random) / std::sqrt(1 - memory * memory);
  for (std::size_t k = 0; k < count; ++k) {
    series.push_back(3 + off);
    off = memory * off + normal(random);
  }
  return series;
}

double coverage(double memory, std::size_t count) {
  constexpr int trials = 2000;
  std::mt19937_64 random(1);
  int covered = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto mean = mean_over_time(process(memory, count, random));
    covered += mean->lower <= 3 && 3 <= mean->upper ? 1 : 0;
  }
  return static_cast<double>(covered) / trials;
}

TEST(MeanOverTime, CoversTheMeanOfAKnownProcessAsOftenAsItClaims) {
  for (const auto& [memory, count] :
       {std::pair(0.0, 50U), {0.0, 200U}, {0.5, 100U}, {0.8, 200U}, {0.9, 200U}}) {
    EXPECT_GE(coverage(memory, count), 0.925) << memory << " " << count;
    EXPECT_LE(coverage(memory, count), 0.99) << memory << " " << count;
  }
}

// An interval that takes the values as independent covers half of the means.
TEST(MeanOverTime, IsWiderThanTheIntervalOfIndependentValues) {
  std::mt19937_64 random(1);
  int covered = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto naive = mean_of_independent(process(0.9, 200, random));
    covered += naive->lower <= 3 && 3 <= naive->upper ? 1 : 0;
  }
  EXPECT_LT(covered, 250);
}

// The closed form is the variance over resamples that are really drawn.
TEST(MeanOverTime, HasTheVarianceOfDrawnResamples) {
  std::mt19937_64 random(2);
  constexpr std::size_t count = 100, block = 20;
  const std::vector<double> series = process(0.6, count, random);
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / count;
  constexpr int resamples = 40'000;
  std::uniform_int_distribution<std::size_t> first(0, count - 1);
  double squares = 0;
  for (int r = 0; r < resamples; ++r) {
    double sum = 0;
    for (std::size_t b = 0; b < count / block; ++b)
      for (std::size_t k = 0, at = first(random); k < block; ++k) sum += series[(at + k) % count];
    squares += (sum / count - mean) * (sum / count - mean) / resamples;
  }
  const auto found = mean_over_time(series);
  ASSERT_TRUE(found);
  const double error = (found->upper - found->lower) / 2 / student_95(4);
  EXPECT_NEAR(error * error * (1 - static_cast<double>(block) / count), squares, 0.03 * squares);
}

TEST(MeanOverTime, ConstantAndShortSeries) {
  const auto constant = mean_over_time(std::vector<double>(60, 2.5));
  ASSERT_TRUE(constant);
  EXPECT_EQ(constant->lower, 2.5);
  EXPECT_EQ(constant->upper, 2.5);
  EXPECT_FALSE(mean_over_time(std::vector<double>(least_series - 1, 1.0)));
}

TEST(RatioOverTime, ProportionalSeriesHaveAnExactRatio) {
  std::mt19937_64 random(3);
  std::vector<double> below = process(0.5, 80, random), above = below;
  for (double& value : above) value *= 1.5;
  const auto ratio = ratio_over_time(above, below);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->mean, 1.5, 1e-12);
  EXPECT_NEAR(ratio->upper - ratio->lower, 0, 1e-12);
  above.front() += 5;
  EXPECT_GT(ratio_over_time(above, below)->upper - ratio_over_time(above, below)->lower, 0.01);
  EXPECT_FALSE(ratio_over_time(above, std::vector<double>(80, 0.0)));
}

}  // namespace
}  // namespace kds::mean_interval_test
