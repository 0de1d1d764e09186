#pragma once
// Counts how often a 95% interval contains the true value, over data that are generated with a known truth.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <string_view>
#include <utility>

namespace kds::test {

inline constexpr int coverage_runs = 400;

/// The share of intervals that must contain the true value: 90 to 98%; 90% or more, for data whose spread the
/// interval overestimates; less than 90%, for data that the interval's header excludes.
enum class Coverage { as_claimed, may_be_more, beyond_the_claim };

/// Calls interval_of(random) for each run. The function generates data and returns the ends of their interval
/// as an optional pair, or nothing. Prints a row of a table: the kind of interval, the data, the share of
/// intervals that contain `truth`, and the share of runs without an interval. Expects the share that `claim`
/// says.
template <class IntervalOf>
void expect_coverage(std::string_view kind, std::string_view data, double truth,
                     const IntervalOf& interval_of, Coverage claim = Coverage::as_claimed) {
  std::mt19937_64 random(1);
  int held = 0, given = 0;
  for (int run = 0; run < coverage_runs; ++run)
    if (const auto ends = interval_of(random)) {
      ++given;
      held += ends->first <= truth && truth <= ends->second ? 1 : 0;
    }
  ASSERT_GT(given, 0) << data;
  const double share = 100.0 * held / given;
  fmt::print("| {} | {} | {:.1f}% | {:.1f}% |\n", kind, data, share, 100 - 100.0 * given / coverage_runs);
  std::fflush(stdout);
  if (claim == Coverage::beyond_the_claim) {
    EXPECT_LT(share, 90) << data;
    return;
  }
  EXPECT_GE(share, 90) << data;
  EXPECT_LE(share, claim == Coverage::may_be_more ? 100 : 98) << data;
}

}  // namespace kds::test
