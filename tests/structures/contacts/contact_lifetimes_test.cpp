#include "structures/contacts/contact_lifetimes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/rounds.h"

namespace kds::contact_lifetimes_test {
namespace {

using testing::ElementsAre;

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

std::vector<PairLifetimes> pairs_of(const ContactLifetimes& all, double run_length) {
  std::vector<PairLifetimes> pairs;
  all.visit_pairs(run_length, [&](const PairLifetimes& pair) { pairs.push_back(pair); });
  return pairs;
}

TEST(ContactLifetimes, FiguresOfAPair) {
  const auto all =
      lifetimes({interval(0, 3, 0, 1, true), interval(1, 2, 0, 10, true, true), interval(0, 3, 2, 2.5),
                 interval(0, 3, 4, 7), interval(0, 3, 8.5, 10, false, true)});
  const auto pairs = pairs_of(all, 10);
  ASSERT_EQ(pairs.size(), 2U);
  const PairLifetimes& pair = pairs[0];
  EXPECT_EQ(pair.first, 0U);
  EXPECT_EQ(pair.second, 3U);
  EXPECT_EQ(pair.contacts, 4U);
  EXPECT_EQ(pair.total, 6);
  EXPECT_EQ(pair.occupancy(), 0.6);
  EXPECT_EQ(pair.mean(), 1.5);
  EXPECT_EQ(pair.median, 1.25);  // of 0.5, 1, 1.5 and 3
  EXPECT_EQ(pair.longest, 3);
  EXPECT_EQ(pair.first_begin.rounded.frame, 0);
  EXPECT_EQ(pair.last_end.rounded.frame, 10);
  EXPECT_EQ(pair.open_at_start, 1U);
  EXPECT_EQ(pair.open_at_end, 1U);
  EXPECT_EQ(pair.open_at_both, 0U);
  EXPECT_EQ(pair.begin_rate(), 3 / 4.0);
  EXPECT_EQ(pair.end_rate(), 3 / 6.0);
  EXPECT_EQ(pair.residence(), 2);
  const PairLifetimes& always = pairs[1];
  EXPECT_EQ(always.occupancy(), 1);
  EXPECT_EQ(always.open_at_both, 1U);
  EXPECT_EQ(always.begin_rate(), std::nullopt);
  EXPECT_EQ(always.end_rate(), 0);
  EXPECT_EQ(always.residence(), std::nullopt);
  const LifetimeFigures sum = all.all(10);
  EXPECT_EQ(sum.contacts, 5U);
  EXPECT_EQ(sum.occupancy(), 0.8);
  EXPECT_EQ(sum.median, 1.5);
}

// The example of Kaplan and Meier's estimate: ends at 1, 3, 3, 6, censored at 2, 3, 7.
TEST(ContactLifetimes, SurvivalOfCensoredContacts) {
  const auto all = lifetimes({interval(0, 1, 0, 1), interval(0, 2, 0, 2, true), interval(0, 3, 1, 4),
                              interval(0, 4, 2, 5), interval(0, 5, 7, 10, false, true), interval(0, 6, 1, 7),
                              interval(0, 7, 3, 10, false, true)});
  const auto points = all.survival();
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].length, 1);
  EXPECT_EQ(points[0].at_risk, 7U);
  EXPECT_NEAR(points[0].survival, 6 / 7.0, 1e-15);
  EXPECT_EQ(points[1].length, 3);
  EXPECT_EQ(points[1].at_risk, 5U);
  EXPECT_EQ(points[1].ended, 2U);
  EXPECT_EQ(points[1].censored, 1U);
  EXPECT_NEAR(points[1].survival, 18 / 35.0, 1e-15);
  EXPECT_NEAR(points[2].survival, 9 / 35.0, 1e-15);
  EXPECT_EQ(points[3].length, 7);  // the last length, at which none ends
  EXPECT_NEAR(points[3].survival, 9 / 35.0, 1e-15);
  // R 4.2: survfit(Surv(c(1,2,3,3,3,6,7), c(1,0,1,1,0,1,0)) ~ 1, conf.type = "log-log")
  const double variance = 1 / 42.0 + 2 / 15.0;
  const double width = 1.959963984540054 * std::sqrt(variance) / -std::log(18 / 35.0);
  EXPECT_NEAR(*points[1].lower, std::pow(18 / 35.0, std::exp(width)), 1e-12);
  EXPECT_NEAR(*points[1].upper, std::pow(18 / 35.0, std::exp(-width)), 1e-12);
  EXPECT_LT(*points[1].lower, points[1].survival);
  EXPECT_GT(*points[1].upper, points[1].survival);
}

TEST(ContactLifetimes, SurvivalEndsAtZeroWithoutABand) {
  const auto points = lifetimes({interval(0, 1, 0, 1), interval(0, 1, 3, 5)}).survival();
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].survival, 0);
  EXPECT_EQ(points[1].lower, std::nullopt);
  EXPECT_EQ(points[1].upper, std::nullopt);
  EXPECT_TRUE(ContactLifetimes().survival().empty());
  EXPECT_EQ(ContactLifetimes().all(10).contacts, 0U);
}

/// Computes the estimate by its definition, one length after the other.
double survival_at(const std::vector<ContactInterval>& intervals, double length) {
  std::vector<double> ends;
  for (const auto& i : intervals)
    if (!i.open_at_start && !i.open_at_end) ends.push_back(i.length());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  double survival = 1;
  for (const double end : ends) {
    if (end > length) break;
    double at_risk = 0, ended = 0;
    for (const auto& i : intervals) {
      at_risk += i.length() >= end ? 1 : 0;
      ended += i.length() == end && !i.open_at_start && !i.open_at_end ? 1 : 0;
    }
    survival *= 1 - ended / at_risk;
  }
  return survival;
}

TEST(ContactLifetimes, RandomIntervals) {
  std::mt19937 random(40);
  for (int round = 0; round < test::rounds(30); ++round) {
    std::vector<ContactInterval> intervals;
    for (unsigned k = 0; k < 1 + random() % 60; ++k) {
      const double begin = static_cast<double>(random() % 40) / 4;
      intervals.push_back(interval(random() % 3, 3 + random() % 2, begin,
                                   begin + static_cast<double>(random() % 20) / 4, random() % 5 == 0,
                                   random() % 5 == 0));
    }
    const auto all = lifetimes(intervals);
    for (const SurvivalPoint& point : all.survival())
      ASSERT_NEAR(point.survival, survival_at(intervals, point.length), 1e-12);
    for (const PairLifetimes& pair : pairs_of(all, 20)) {
      std::vector<double> lengths;
      for (const auto& i : intervals)
        if (i.first == pair.first && i.second == pair.second) lengths.push_back(i.length());
      std::sort(lengths.begin(), lengths.end());
      ASSERT_EQ(pair.contacts, lengths.size());
      ASSERT_EQ(pair.median, 0.5 * (lengths[(lengths.size() - 1) / 2] + lengths[lengths.size() / 2]));
    }
    // Points that are left out change nothing else.
    const auto whole = all.survival(), thin = all.survival(0.2);
    ASSERT_LE(thin.size(), 7U);
    ASSERT_EQ(thin.back().length, whole.back().length);
    ASSERT_EQ(thin.back().survival, whole.back().survival);
  }
}

}  // namespace
}  // namespace kds::contact_lifetimes_test
