#include "structures/contacts/contact_lifetimes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/rounds.h"

namespace kds::contact_lifetimes_test {
namespace {

ContactInterval interval(std::uint32_t first, std::uint32_t second, double begin, double end,
                         bool at_start = false, bool at_end = false) {
  const auto at = [](double time) {
    const double step = std::floor(time);
    return ContactMoment{
        static_cast<std::size_t>(step), time - step, time - step, {step, step + 1}, {time, {}}};
  };
  return {first, second, at(begin), at(end), at_start, at_end};
}

ContactLifetimes lifetimes(const std::vector<ContactInterval>& intervals) {
  ContactLifetimes all;
  for (const ContactInterval& i : intervals) all.add(i);
  return all;
}

void expect_near(const Estimate& estimate, double value, double lower, double upper) {
  EXPECT_NEAR(estimate.value.value_or(NAN), value, 1e-12);
  EXPECT_NEAR(estimate.lower.value_or(NAN), lower, 2e-6 * (1 + lower));
  EXPECT_NEAR(estimate.upper.value_or(NAN), upper, 2e-6 * (1 + upper));
}

TEST(ContactLifetimes, FiguresOfAPair) {
  const auto all =
      lifetimes({interval(0, 3, 0, 1, true), interval(1, 2, 0, 10, true, true), interval(0, 3, 2, 2.5),
                 interval(0, 3, 4, 7), interval(0, 3, 8.5, 10, false, true)});
  const auto pairs = all.pairs(10);
  ASSERT_EQ(pairs.size(), 2U);
  const PairLifetimes& pair = pairs[0];
  EXPECT_EQ(pair.first, 0U);
  EXPECT_EQ(pair.second, 3U);
  EXPECT_EQ(pair.contacts, 4U);
  EXPECT_EQ(pair.total, 6);
  EXPECT_EQ(pair.longest, 3);
  EXPECT_EQ(pair.first_begin.rounded.frame, 0);
  EXPECT_EQ(pair.last_end.rounded.frame, 10);
  EXPECT_EQ(pair.open_at_start, 1U);
  EXPECT_EQ(pair.open_at_end, 1U);
  EXPECT_EQ(pair.open_at_both, 0U);
  // In R: qchisq(0.025, 6) / 2 = 0.618672, qchisq(0.975, 8) / 2 = 8.767273.
  expect_near(pair.begin_rate, 3 / 4.0, 0.618672 / 4, 8.767273 / 4);
  expect_near(pair.end_rate, 3 / 6.0, 0.618672 / 6, 8.767273 / 6);
  expect_near(pair.residence, 2, 6 / 8.767273, 6 / 0.618672);
  // qbeta(0.025, 3, 4) = 0.118117, qbeta(0.975, 4, 3) = 0.881883
  const double odds = 6 / 4.0 * 0.118117 / 0.881883, other = 6 / 4.0 * 0.881883 / 0.118117;
  expect_near(pair.occupancy, 0.6, odds / (1 + odds), other / (1 + other));
  const PairLifetimes& always = pairs[1];
  EXPECT_EQ(always.open_at_both, 1U);
  EXPECT_EQ(always.occupancy, (Estimate{1.0, {}, {}}));
  EXPECT_EQ(always.begin_rate, Estimate());
  expect_near(always.end_rate, 0, 0, 0.299573);  // -log(0.05) / 10
  EXPECT_EQ(always.residence.value, std::nullopt);
  EXPECT_NEAR(*always.residence.lower, 3.338082, 1e-6);
  EXPECT_EQ(always.residence.upper, std::nullopt);
}

// A contact that begins in the run and never ends, and one that ends and never comes back.
TEST(ContactLifetimes, EndsOfIntervalsThatTheRunDoesNotShow) {
  const auto pairs = lifetimes({interval(0, 1, 6, 10, false, true), interval(0, 2, 0, 4, true)}).pairs(10);
  expect_near(pairs[0].occupancy, 0.4, 4 * 0.025 / (4 * 0.025 + 6 * 0.975), 1);  // qbeta(0.025, 1, 1)
  expect_near(pairs[1].occupancy, 0.4, 0, 4 * 0.975 / (4 * 0.975 + 6 * 0.025));
  expect_near(pairs[1].begin_rate, 0, 0, 2.995732 / 6);
}

// Three of ten pairs meet. The expected variances are those of the linearized ratios.
TEST(ContactLifetimes, FiguresOfAllPairsCountThoseThatNeverMeet) {
  const auto lives = lifetimes(
      {interval(0, 1, 1, 3), interval(0, 1, 4, 5), interval(0, 2, 2, 8), interval(0, 3, 0, 10, true, true)});
  const LifetimeFigures all = lives.all(10, 10);
  EXPECT_EQ(all.contacts, 4U);
  EXPECT_EQ(all.total, 19);
  EXPECT_EQ(all.run_length, 100);
  EXPECT_EQ(all.occupancy.value, 0.19);
  EXPECT_EQ(all.begin_rate.value, 3 / 81.0);
  EXPECT_EQ(all.end_rate.value, 3 / 19.0);
  EXPECT_DOUBLE_EQ(*all.residence.value, 19 / 3.0);
  const auto squared = [](double x) { return x * x; };
  const double variance =
      1.5 * (squared(2 / 3.0 - 3 / 19.0) + squared(1 / 3.0 - 6 / 19.0) + squared(10 / 19.0));
  const double factor = std::exp(4.302653 * std::sqrt(variance));  // qt(0.975, 2)
  expect_near(all.end_rate, 3 / 19.0, 3 / 19.0 / factor, 3 / 19.0 * factor);
  EXPECT_DOUBLE_EQ(*all.residence.lower, 1 / *all.end_rate.upper);
  // Equal pairs do not show how much pairs differ, so the interval is that of constant rates.
  const LifetimeFigures equal = lifetimes({interval(0, 1, 1, 3), interval(0, 2, 4, 6)}).all(10, 2);
  expect_near(equal.end_rate, 0.5, 0.242209 / 4, 7.224688 / 4);  // qchisq(0.025, 4) / 2, qchisq(0.975, 6) / 2
  const LifetimeFigures none = ContactLifetimes().all(10, 3);
  EXPECT_EQ(none.occupancy, (Estimate{0.0, {}, {}}));
  expect_near(none.begin_rate, 0, 0, 2.995732 / 30);
  EXPECT_EQ(none.residence, Estimate());
  EXPECT_EQ(ContactLifetimes().all(10, 0).occupancy, Estimate());
}

// The example of Kaplan and Meier's estimate: ends at 1, 3, 3, 6, censored at 2, 3, 7. Each pair has one
// contact. The contact that is open at the start is left out.
TEST(ContactLifetimes, SurvivalOfCensoredContacts) {
  const auto survival =
      lifetimes({interval(0, 1, 0, 1), interval(0, 2, 8, 10, false, true), interval(0, 3, 1, 4),
                 interval(0, 4, 2, 5), interval(0, 5, 7, 10, false, true), interval(0, 6, 1, 7),
                 interval(0, 7, 3, 10, false, true), interval(0, 8, 0, 3.5, true)})
          .survival();
  const auto& points = survival.points;
  EXPECT_EQ(survival.contacts, 7U);
  EXPECT_EQ(survival.left_out, 1U);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].length, 1);
  EXPECT_EQ(points[0].at_risk, 7U);
  EXPECT_NEAR(*points[0].survival.value, 6 / 7.0, 1e-15);
  EXPECT_EQ(points[1].length, 3);
  EXPECT_EQ(points[1].at_risk, 5U);
  EXPECT_EQ(points[1].ended, 2U);
  EXPECT_EQ(points[1].censored, 1U);
  EXPECT_NEAR(*points[2].survival.value, 9 / 35.0, 1e-15);
  EXPECT_EQ(points[3].length, 7);  // the last length, at which none ends
  EXPECT_NEAR(*points[3].survival.value, 9 / 35.0, 1e-15);
  // In R: survfit(Surv(c(1,2,3,3,3,6,7), c(1,0,1,1,0,1,0)) ~ 1, conf.type = "log-log"), with the variance
  // times 7/6 and qt(0.975, 6) in place of 1.96
  const double variance = (1 / 42.0 + 2 / 15.0) * 7 / 6;
  const double width = 2.446912 * std::sqrt(variance) / -std::log(18 / 35.0);
  expect_near(points[1].survival, 18 / 35.0, std::pow(18 / 35.0, std::exp(width)),
              std::pow(18 / 35.0, std::exp(-width)));
  EXPECT_EQ(survival.median.value, 6);
  EXPECT_EQ(survival.median.lower, 1);
  EXPECT_EQ(survival.median.upper, std::nullopt);
}

TEST(ContactLifetimes, SurvivalEndsAtZeroWithoutABand) {
  const auto survival = lifetimes({interval(0, 1, 0, 1), interval(0, 1, 3, 5)}).survival();
  ASSERT_EQ(survival.points.size(), 2U);
  EXPECT_EQ(survival.points[1].survival, (Estimate{0.0, {}, {}}));
  const auto open = lifetimes({interval(0, 1, 1, 9, false, true)}).survival();
  ASSERT_EQ(open.points.size(), 1U);
  EXPECT_EQ(open.points[0].survival, (Estimate{1.0, {}, {}}));
  EXPECT_TRUE(ContactLifetimes().survival().points.empty());
}

// Contacts of equal length end at one step, whatever their last digits are, and thinning then counts whole
// steps.
TEST(ContactLifetimes, EqualLengthsAreOneStep) {
  for (const double error : {0.0, 1e-15, -3e-16, 4e-15}) {
    std::vector<ContactInterval> intervals;
    for (std::uint32_t k = 1; k <= 300; ++k)
      intervals.push_back(interval(0, k, 1.0 / k, 1.0 / k + (k <= 200 ? 1.5 : 3) + (k % 2 == 0 ? error : 0)));
    const auto points = lifetimes(intervals).survival(1.0 / 250).points;
    ASSERT_EQ(points.size(), 2U) << error;
    EXPECT_EQ(points[0].ended, 200U);
    EXPECT_NEAR(points[0].length, 1.5, 1e-12);
    EXPECT_NEAR(*points[0].survival.value, 1 / 3.0, 1e-12);
  }
}

/// Returns the estimate and the variance of its logarithm by their definitions, one contact after the other.
std::pair<double, double> survival_at(const std::vector<ContactInterval>& intervals, double length) {
  double survival = 1;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> residuals;
  for (const auto& i : intervals)
    if (!i.open_at_start) residuals[{i.first, i.second}] = 0;
  std::set<double> lengths;
  for (const auto& i : intervals) lengths.insert(i.length());
  for (const double end : lengths) {
    double at_risk = 0, ended = 0;
    for (const auto& i : intervals) {
      if (i.open_at_start) continue;
      at_risk += i.length() >= end ? 1 : 0;
      ended += i.length() == end && !i.open_at_end ? 1 : 0;
    }
    if (end > length || at_risk == ended) break;
    survival *= 1 - ended / at_risk;
    for (const auto& i : intervals) {
      if (i.open_at_start || i.length() < end) continue;
      double& residual = residuals[{i.first, i.second}];
      residual += ended / at_risk / (at_risk - ended);
      if (i.length() == end && !i.open_at_end) residual -= 1 / (at_risk - ended);
    }
  }
  double squares = 0;
  for (const auto& [pair, residual] : residuals) squares += residual * residual;
  return {survival, squares};
}

TEST(ContactLifetimes, RandomIntervals) {
  std::mt19937 random(40);
  std::size_t bands = 0;
  for (int round = 0; round < test::rounds(30); ++round) {
    std::vector<ContactInterval> intervals;
    for (unsigned k = 0; k < 1 + random() % 60; ++k) {
      const double begin = static_cast<double>(random() % 40) / 4;
      intervals.push_back(interval(random() % 3, 3 + random() % 2, begin,
                                   begin + static_cast<double>(random() % 20) / 4, random() % 5 == 0,
                                   random() % 5 == 0));
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> contacts;
    for (const auto& i : intervals)
      if (!i.open_at_start) ++contacts[{i.first, i.second}];
    double sum = 0, squares = 0;
    for (const auto& [pair, count] : contacts) {
      sum += count;
      squares += count * count;
    }
    const double n = sum * sum / squares;
    const auto all = lifetimes(intervals);
    const auto whole = all.survival().points, thin = all.survival(0.2).points;
    for (const SurvivalPoint& point : whole) {
      const auto [survival, variance] = survival_at(intervals, point.length);
      if (*point.survival.value == 0) continue;
      ASSERT_NEAR(*point.survival.value, survival, 1e-12);
      if (!point.survival.lower || contacts.size() < 2) continue;
      const double width = student_quantile(n - 1) * std::sqrt(variance * n / (n - 1));
      ASSERT_NEAR(*point.survival.lower, std::pow(survival, std::exp(-width / std::log(survival))), 1e-9);
      ASSERT_NEAR(*point.survival.upper, std::pow(survival, std::exp(width / std::log(survival))), 1e-9);
      ++bands;
    }
    // Points that are left out change nothing else.
    if (whole.empty()) continue;
    ASSERT_LE(thin.size(), 7U);
    ASSERT_EQ(thin.back().length, whole.back().length);
    ASSERT_EQ(thin.back().survival, whole.back().survival);
  }
  EXPECT_GT(bands, test::rounds(100U));
}

}  // namespace
}  // namespace kds::contact_lifetimes_test
