// How often 95% intervals of contact figures contain the true value: contacts of known rates, generated and
// measured many times. Prints a table, which docs/findings.md quotes.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "structures/contacts/contact_lifetimes.h"

namespace kds::contact_coverage_test {
namespace {

/// Rates at which a pair begins and ends contacts.
struct Pair {
  double begin, end;
  [[nodiscard]] double share() const { return begin / (begin + end); }
  [[nodiscard]] double begins() const { return end * share(); }  // per time
};
using Pairs = std::vector<Pair>;

class Random {
 public:
  double uniform() { return (static_cast<double>(bits_() >> 11U) + 0.5) * 0x1p-53; }
  double exponential(double rate) { return -std::log(uniform()) / rate; }
  double normal() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform()); }

 private:
  std::mt19937_64 bits_{49};
};

struct Scene {
  const char* name;
  int asked;                  ///< pairs
  double meeting;             ///< the share of pairs that ever meet
  double begin, end, spread;  ///< rates, and the standard deviation of their logarithms
  bool anew;                  ///< pairs are drawn anew in each run, otherwise once
  double length;
  std::vector<double> times;  ///< of the survival function

  /// Returns the pairs that meet.
  [[nodiscard]] Pairs draw(Random& random) const {
    Pairs drawn;
    for (int k = 0; k < asked; ++k)
      if (random.uniform() < meeting)
        drawn.push_back(
            {begin * std::exp(spread * random.normal()), end * std::exp(spread * random.normal())});
    return drawn;
  }
};

enum class Start : std::uint8_t { equilibrium, in_contact };

ContactLifetimes run(const Pairs& pairs, double length, Start start, Random& random) {
  ContactLifetimes lifetimes;
  const auto at = [](double time) {
    const double step = std::floor(time);
    return ContactMoment{static_cast<std::size_t>(step), time - step, time - step, {step, step + 1}, {}};
  };
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    bool on = start == Start::in_contact || random.uniform() < pairs[k].share(), is_open = true;
    for (double time = 0; time < length;) {
      const double next = time + random.exponential(on ? pairs[k].end : pairs[k].begin);
      if (on) lifetimes.add({0, k + 1, at(time), at(std::min(next, length)), is_open, next >= length});
      time = next;
      is_open = false;
      on = !on;
    }
  }
  return lifetimes;
}

/// Returns the number with one decimal.
std::string fixed(double number) {
  const long tenths = std::lround(10 * number);
  return std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10);
}

/// Counts the intervals that contain the true value. Prints their shares as a line of a table.
class Coverage {
 public:
  void add(const std::string& figure, const Estimate& estimate, double truth) {
    Count& count = count_of(figure);
    if (!estimate.lower && !estimate.upper) return;
    ++count.intervals;
    const bool misses =
        (estimate.lower && *estimate.lower > truth) || (estimate.upper && *estimate.upper < truth);
    count.held += misses ? 0 : 1;
  }
  void expect(const std::string& name, double least, double most) {
    std::string line = "| " + name + " |";
    for (const Count& count : counts_) {
      const double share = static_cast<double>(count.held) / count.intervals;
      EXPECT_GE(share, least) << name << ": " << count.figure;
      EXPECT_LE(share, most) << name << ": " << count.figure;
      line += ' ' + count.figure + ' ' + fixed(100 * share) + "% |";
    }
    std::puts(line.c_str());
  }

 private:
  struct Count {
    std::string figure;
    int intervals = 0, held = 0;
  };
  Count& count_of(const std::string& figure) {
    for (Count& count : counts_)
      if (count.figure == figure) return count;
    return counts_.emplace_back(Count{figure});
  }
  std::vector<Count> counts_;
};

constexpr int runs = 400;

/// The true figures of all pairs together.
struct Truth {
  double asked = 0, on = 0, begins = 0;
  std::vector<std::pair<double, double>> lives;  // beginnings per time, and the rate at which they end

  void add(const Pairs& drawn, int pairs_asked) {
    asked += pairs_asked;
    for (const Pair& pair : drawn) {
      on += pair.share();
      begins += pair.begins();
      lives.emplace_back(pair.begins(), pair.end);
    }
  }
  [[nodiscard]] double survival(double time) const {
    double sum = 0;
    for (const auto& [weight, rate] : lives) sum += weight * std::exp(-rate * time);
    return sum / begins;
  }
  [[nodiscard]] double median() const {
    double low = 0, high = 1e6;
    for (int k = 0; k < 60; ++k) (survival((low + high) / 2) > 0.5 ? low : high) = (low + high) / 2;
    return low;
  }
};

Estimate survival_at(const Survival& survival, double time) {
  Estimate at;
  if (survival.points.empty() || survival.points.back().length < time) return at;
  for (const SurvivalPoint& point : survival.points)
    if (point.length <= time) at = point.survival;
  return at;
}

void expect_covered(const Scene& scene, double least, double most) {
  Random random;
  Coverage coverage;
  const Pairs once = scene.draw(random);
  Truth truth;
  truth.add(once, scene.asked);
  for (int k = 0; scene.anew && k < 1000; ++k) truth.add(scene.draw(random), scene.asked);
  const double median = truth.median();
  for (int k = 0; k < runs; ++k) {
    const ContactLifetimes lifetimes =
        run(scene.anew ? scene.draw(random) : once, scene.length, Start::equilibrium, random);
    const Survival survival = lifetimes.survival();
    for (const double time : scene.times)
      coverage.add("S(" + std::to_string(static_cast<int>(time)) + ")", survival_at(survival, time),
                   truth.survival(time));
    coverage.add("median", survival.median, median);
    const LifetimeFigures all = lifetimes.all(scene.length, static_cast<std::size_t>(scene.asked));
    coverage.add("occupancy", all.occupancy, truth.on / truth.asked);
    coverage.add("begin", all.begin_rate, truth.begins / (truth.asked - truth.on));
    coverage.add("end", all.end_rate, truth.begins / truth.on);
    coverage.add("residence", all.residence, truth.on / truth.begins);
  }
  coverage.expect(scene.name, least, most);
}

TEST(ContactCoverage, FiguresOfAllPairs) {
  const std::vector<double> times{10, 20, 40, 60, 80};
  expect_covered(
      {"267 pairs, mean life 50, as long apart, 100 frames", 267, 1, 0.02, 0.02, 0, false, 100, times}, 0.9,
      0.98);
  expect_covered({"1,000 pairs, of which one in 20 meets, mean life 20, 100 frames",
                  1000,
                  0.05,
                  0.05,
                  0.05,
                  0,
                  true,
                  100,
                  {5, 10, 20, 30, 40}},
                 0.9, 0.98);
  expect_covered(
      {"267 pairs, rates differ by factors of 2.7, 100 frames", 267, 1, 0.02, 0.02, 1, true, 100, times}, 0.9,
      0.98);
  expect_covered({"20 such pairs, 300 frames", 20, 1, 0.02, 0.02, 1, true, 300, times}, 0.9, 0.98);
  expect_covered(
      {"one pair, mean life 20, 2,000 frames", 1, 1, 0.05, 0.05, 0, false, 2000, {5, 10, 20, 30, 40}}, 0.9,
      0.98);
  // Intervals are too wide if pairs differ and are the same in each run.
  expect_covered({"267 pairs, rates differ by factors of 2.7, the same pairs in each run", 267, 1, 0.02, 0.02,
                  1, false, 100, times},
                 0.93, 1);
  // Few pairs make most contacts, and other few in each run.
  expect_covered({"560 pairs, of which 15% meet, rates differ by factors of 4.5, 1,000 frames",
                  560,
                  0.15,
                  0.05,
                  0.01,
                  1.5,
                  true,
                  1000,
                  {3, 10, 40, 100, 250}},
                 0.75, 0.98);
}

TEST(ContactCoverage, FiguresOfOnePair) {
  struct Rates {
    double begin, end;  // times the length of the run
  };
  for (const auto& [begin, end] :
       std::vector<Rates>{{3, 3}, {5, 5}, {5, 20}, {20, 5}, {20, 20}, {100, 100}}) {
    Random random;
    Coverage coverage;
    const Pair pair{begin / 100, end / 100};
    for (int k = 0; k < 10 * runs; ++k)
      for (const PairLifetimes& one : run({pair}, 100, Start::equilibrium, random).pairs(100)) {
        coverage.add("occupancy", one.occupancy, pair.share());
        coverage.add("begin", one.begin_rate, pair.begin);
        coverage.add("end", one.end_rate, pair.end);
        coverage.add("residence", one.residence, 1 / pair.end);
      }
    coverage.expect("mean life 1/" + std::to_string(static_cast<int>(end)) + " of the run, apart 1/" +
                        std::to_string(static_cast<int>(begin)),
                    0.9, 0.985);
  }
}

// The pair is in contact at the start and hardly ever comes back. If it never ends, the bound is one-sided.
TEST(ContactCoverage, LowerBoundsOfLives) {
  for (const double ends : {1.0, 2.5, 3.1}) {
    Random random;
    Coverage coverage;
    int bounds = 0;
    for (int k = 0; k < 10 * runs; ++k) {
      const PairLifetimes one = run({{1e-9, ends / 100}}, 100, Start::in_contact, random).pairs(100).front();
      coverage.add("residence", one.residence, 100 / ends);
      bounds += one.residence.value ? 0 : 1;
    }
    coverage.expect("mean life 1/" + fixed(ends) + " of the run, " + std::to_string(bounds) + " lower bounds",
                    0.9, 0.98);
  }
}

}  // namespace
}  // namespace kds::contact_coverage_test
