// Prints for each interval of the program how often it contains the true value, over generated data that are
// like those of runs, and expects that it does so as often as it claims.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/program/mean_interval.h"
#include "tests/support/coverage.h"

namespace kds::test::coverage_test {
namespace {

using Random = std::mt19937_64;
using Series = std::vector<double>;
using Ends = std::optional<std::pair<double, double>>;

Ends ends_of(const std::optional<MeanInterval>& interval) {
  return interval ? Ends({interval->lower, interval->upper}) : std::nullopt;
}

double normal(Random& random) { return std::normal_distribution<double>()(random); }
double poisson(double mean, Random& random) {
  return mean > 0 ? static_cast<double>(std::poisson_distribution<int>(mean)(random)) : 0;
}

// Returns an autoregressive process of order 1 with mean 0 and variance 1. Its integrated correlation time is
// (1 + memory) / (1 - memory).
Series process(double memory, std::size_t count, Random& random) {
  Series series;
  double off = normal(random);
  for (std::size_t k = 0; k < count; ++k) {
    series.push_back(off);
    off = memory * off + std::sqrt(1 - memory * memory) * normal(random);
  }
  return series;
}

// Returns the rates of such a process: log-normal, with this mean.
Series rates(double mean, double spread, double memory, std::size_t count, Random& random) {
  Series series = process(memory, count, random);
  for (double& value : series) value = mean * std::exp(spread * value - spread * spread / 2);
  return series;
}

Series counts(double mean, double spread, double memory, std::size_t count, Random& random) {
  Series series = rates(mean, spread, memory, count, random);
  for (double& value : series) value = poisson(value, random);
  return series;
}

// Returns counts of a motion that is quiet for 45 steps and busy for 5 on average, with 4 events a busy step.
Series switching(std::size_t count, Random& random) {
  std::uniform_real_distribution<double> share;
  bool busy = share(random) < 0.1;
  Series series;
  for (std::size_t k = 0; k < count; ++k) {
    series.push_back(busy ? poisson(4, random) : 0);
    busy = busy ? share(random) >= 1.0 / 5 : share(random) < 1.0 / 45;
  }
  return series;
}

// Returns counts of steps of which one in ten has a burst of 5 events on average.
Series bursts(std::size_t count, Random& random) {
  std::bernoulli_distribution begins(0.1);
  std::geometric_distribution<int> more(0.2);
  Series series(count, 0);
  for (double& value : series)
    if (begins(random)) value = 1 + more(random);
  return series;
}

struct SeriesCase {
  std::string data;
  double mean;
  std::function<Series(Random&)> make;
  Coverage claim = Coverage::as_claimed;
};

TEST(Coverage, OfMeansOverTime) {
  std::vector<SeriesCase> cases;
  const auto add_process = [&](double memory, std::size_t count) {
    cases.push_back({"normal, " + std::to_string(count) + " steps, correlation time " +
                         std::to_string(std::lround((1 + memory) / (1 - memory))),
                     3, [=](Random& random) {
                       Series series = process(memory, count, random);
                       for (double& value : series) value = 3 + value / 2;
                       return series;
                     }});
  };
  for (const auto& [memory, count] :
       {std::pair(0.0, 50U), {0.5, 50U}, {0.9, 50U}, {0.8, 200U}, {0.9, 200U}, {0.98, 200U}, {0.99, 1000U}})
    add_process(memory, count);
  cases.push_back({"counts of mean 8, 50 steps", 8, [](Random& r) { return counts(8, 0.3, 0.5, 50, r); }});
  cases.push_back(
      {"counts of mean 1, slow rate, 200 steps", 1, [](Random& r) { return counts(1, 0.5, 0.9, 200, r); }});
  cases.push_back({"20 events in 200 steps", 0.1, [](Random& r) { return counts(0.1, 0, 0, 200, r); }});
  cases.push_back({"5 events in 200 steps", 0.025, [](Random& r) { return counts(0.025, 0, 0, 200, r); },
                   Coverage::may_be_more});
  cases.push_back({"bursts of 5, 200 steps", 0.5, [](Random& r) { return bursts(200, r); }});
  cases.push_back({"busy and quiet times, 500 steps", 0.4, [](Random& r) { return switching(500, r); }});
  cases.push_back({"values that swing around the mean, 200 steps", 3,
                   [](Random& random) {
                     const Series noise = process(0, 201, random);
                     Series series;
                     for (std::size_t k = 0; k < 200; ++k)
                       series.push_back(3 + noise[k + 1] - 0.7 * noise[k]);
                     return series;
                   },
                   Coverage::may_be_more});
  cases.push_back({"beyond the claim: slow motion under noise, 200 steps", 3,
                   [](Random& random) {
                     Series series = process(0.99, 200, random);
                     for (double& value : series) value = 3 + 0.5 * value + 0.8 * normal(random);
                     return series;
                   },
                   Coverage::beyond_the_claim});
  for (const SeriesCase& one : cases)
    expect_coverage(
        "mean over steps", one.data, one.mean,
        [&](Random& random) { return ends_of(above_zero(mean_over_time(one.make(random)))); }, one.claim);
}

// Events per net change: changes that are undone make events without net changes.
TEST(Coverage, OfRatiosOverTime) {
  for (const auto& [mean, undone, memory, count] :
       {std::tuple(8.0, 0.3, 0.5, 50U), {8.0, 2.0, 0.9, 200U}, {0.3, 0.5, 0.5, 200U}, {0.3, 0.5, 0.9, 1000U}})
    expect_coverage("events per net change",
                    fmt::format("{} changes a step, {} undone for each, {} steps, correlation time {}", mean,
                                undone, count, std::lround((1 + memory) / (1 - memory))),
                    1 + undone, [&](Random& random) {
                      const Series rate = rates(mean, 0.5, memory, count, random);
                      const Series share = rates(undone, 0.3, memory, count, random);
                      Series events, net;
                      for (std::size_t k = 0; k < count; ++k) {
                        net.push_back(poisson(rate[k], random));
                        events.push_back(net[k] + poisson(rate[k] * share[k], random));
                      }
                      return ends_of(above_zero(ratio_over_time(events, net)));
                    });
  // The share of contacts that frames miss, which kds missed cuts at 1.
  for (const auto& [mean, missed, memory, count] :
       {std::tuple(3.0, 0.2, 0.5, 100U), {3.0, 0.7, 0.9, 200U}, {0.3, 0.2, 0.5, 200U}})
    expect_coverage("share of contacts missed",
                    fmt::format("{} contacts a step, {} missed, {} steps, correlation time {}", mean, missed,
                                count, std::lround((1 + memory) / (1 - memory))),
                    missed, [&](Random& random) {
                      const Series contacts = counts(mean, 0.5, memory, count, random);
                      Series of_step;
                      for (const double all : contacts)
                        of_step.push_back(static_cast<double>(
                            std::binomial_distribution<int>(static_cast<int>(all), missed)(random)));
                      return ends_of(above_zero(ratio_over_time(of_step, contacts)));
                    });
}

// Means over inputs (compare) and over the tasks of a sweep.
TEST(Coverage, OfMeansOfReplicas) {
  struct Replicas {
    std::string data;
    double mean;
    std::function<double(Random&)> draw;
    Coverage claim = Coverage::as_claimed;
  };
  const auto log_normal = [](double spread) {
    return [spread](Random& random) { return std::exp(spread * normal(random)); };
  };
  const std::vector<Replicas> kinds{
      {"normal, spread a tenth of the mean", 1, [](Random& r) { return 1 + 0.1 * normal(r); }},
      {"log-normal, spread 0.8 of the mean", std::exp(0.7 * 0.7 / 2), log_normal(0.7)},
      {"counts of mean 30", 30, [](Random& r) { return poisson(30, r); }, Coverage::may_be_more},
      {"counts of mean 0.3", 0.3, [](Random& r) { return poisson(0.3, r); }, Coverage::may_be_more},
      {"beyond the claim: log-normal, spread 2.9 of the mean", std::exp(1.5 * 1.5 / 2), log_normal(1.5),
       Coverage::beyond_the_claim},
  };
  for (const Replicas& kind : kinds)
    for (const int seeds : {3, 8}) {
      if (kind.claim == Coverage::beyond_the_claim && seeds == 3) continue;  // the coverage is 90.5%
      expect_coverage(
          "mean over replicas", fmt::format("{}, {} of them", kind.data, seeds), kind.mean,
          [&](Random& random) {
            Series values;
            for (int k = 0; k < seeds; ++k) values.push_back(kind.draw(random));
            return ends_of(above_zero(mean_of_independent(values)));
          },
          kind.claim);
    }
}

}  // namespace
}  // namespace kds::test::coverage_test
