#include "kds/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>

namespace kds::stopwatch_test {
namespace {

/// A clock that moves only when the test says so.
struct StillClock {
  using duration = std::chrono::seconds;
  using time_point = std::chrono::time_point<StillClock, duration>;
  static inline int seconds = 0, reads = 0;
  static time_point now() {
    ++reads;
    return time_point(duration(seconds));
  }
};

TEST(Stopwatch, ChargesEachMomentToOneLane) {
  StopwatchOf<StillClock> watch;
  watch.add_lane();
  watch.add_lane();
  StillClock::seconds += 100;  // before anything is charged
  EXPECT_EQ(watch.charge(1), decltype(watch)::stopped);
  StillClock::seconds += 3;
  EXPECT_EQ(watch.charge(2), 1U);
  StillClock::seconds += 5;
  EXPECT_EQ(watch.charge(1), 2U);
  StillClock::seconds += 7;
  const int reads = StillClock::reads;
  EXPECT_EQ(watch.charge(1), 1U);  // the lane stays
  EXPECT_EQ(StillClock::reads, reads);
  StillClock::seconds += 1;
  EXPECT_EQ(watch.charge(decltype(watch)::stopped), 1U);
  StillClock::seconds += 100;
  EXPECT_EQ(watch.charge(0), decltype(watch)::stopped);
  EXPECT_EQ(watch.seconds(0), 0);
  EXPECT_EQ(watch.seconds(1), 11);
  EXPECT_EQ(watch.seconds(2), 5);
  watch.reset();
  EXPECT_EQ(watch.seconds(1), 0);
}

}  // namespace
}  // namespace kds::stopwatch_test
