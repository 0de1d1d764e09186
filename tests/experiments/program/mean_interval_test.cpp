#include "experiments/program/mean_interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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

// 16 batches of four equal values, of which the first half is 1 and the second 3: squares 16, products 14, so
// the correlation 14/16 becomes (14 + 1 + 3.5) / 16, which is cut at 0.999. One batch tells as much as 1,999,
// so the variance is 16 / (16 - 15), and one degree of freedom is left.
TEST(MeanOverTime, IntervalAsByHand) {
  std::vector<double> series(64, 1);
  std::fill(series.begin() + 32, series.end(), 3);
  const auto mean = mean_over_time(series);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->mean, 2);
  EXPECT_NEAR(mean->upper - 2, std::tan(std::numbers::pi * 0.475) * std::sqrt(16 * 1999.0 / 16), 1e-6);
  // Batches that alternate are not correlated: variance 16 / 15, 15 degrees of freedom.
  for (std::size_t k = 0; k < series.size(); ++k) series[k] = k / 4 % 2 == 0 ? 1 : 3;
  EXPECT_NEAR(mean_over_time(series)->upper - 2, student_95(15) * std::sqrt(16.0 / 15 / 16), 1e-9);
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
