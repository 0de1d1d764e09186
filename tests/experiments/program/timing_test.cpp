#include "experiments/program/timing.h"

#include <gtest/gtest.h>

#include <string>

namespace kds::timing_test {
namespace {

TEST(Timing, WorksGoInTurnsRoundByRound) {
  std::string order;
  const auto work = [&order](char name, double seconds) {
    return [&order, name, seconds] {
      order += name;
      return seconds;
    };
  };
  const auto seconds = seconds_in_turn(3, {work('a', 0.5), work('b', 2), work('c', 0.25)});
  EXPECT_EQ(order, "abcacac");  // b takes long, so it runs once
  EXPECT_EQ(seconds, (std::vector<std::vector<double>>{{0.5, 0.5, 0.5}, {2}, {0.25, 0.25, 0.25}}));
}

TEST(Timing, OneRoundHasNoSpread) {
  EXPECT_EQ(spread_text({0.21, 0.204, 0.233}), "0.210 (0.204 to 0.233)");
  EXPECT_EQ(spread_text(spread_of({0.21})), "0.210");
}

TEST(Timing, RatiosAreOfOneRoundEach) {
  const Spread ratio = ratios_by_round({1, 4, 9}, {1, 2, 3});
  EXPECT_EQ(ratio.least, 1);
  EXPECT_EQ(ratio.median, 2);
  EXPECT_EQ(ratio.most, 3);
  EXPECT_EQ(ratios_by_round({12}, {2, 3, 4}).most, 6);  // one measurement is compared with each of the others
  EXPECT_EQ(ratios_by_round({2, 3, 4}, {2}).least, 1);
}

}  // namespace
}  // namespace kds::timing_test
