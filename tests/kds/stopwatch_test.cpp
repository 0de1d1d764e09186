#include "kds/stopwatch.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace kds::stopwatch_test {
namespace {

/// A clock that moves only when the test says so.
struct StillClock {
  static inline int seconds = 0, reads = 0;
  static std::int64_t nanoseconds() {
    ++reads;
    return std::int64_t{1000000000} * seconds;
  }
};

/// A clock of which each reading takes 7 nanoseconds.
struct SlowClock {
  static inline std::int64_t now = 0;
  static std::int64_t nanoseconds() { return now += 7; }
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

// Work of 3 ns is called until 256 calls take longer than a hundred readings, 700 ns, and again 256 times. No
// figure contains the time of a reading.
TEST(Stopwatch, LeavesOutItsReadings) {
  EXPECT_EQ(nanoseconds_of_reading<SlowClock>(), 7);
  std::size_t calls = 0;
  const auto work = [&] {
    ++calls;
    SlowClock::now += 3;
  };
  EXPECT_DOUBLE_EQ(seconds_of<SlowClock>(work), 3e-9);
  calls = 0;
  EXPECT_DOUBLE_EQ(seconds_per_call<SlowClock>(work), 3e-9);
  EXPECT_EQ(calls, 1U + 2 + 4 + 8 + 16 + 32 + 64 + 128 + 256 + 256);
  calls = 0;
  const auto pauses_once = [&] { SlowClock::now += ++calls == 3 ? 5000 : 3; };
  EXPECT_DOUBLE_EQ(seconds_per_call<SlowClock>(pauses_once), 3e-9);
  EXPECT_DOUBLE_EQ(seconds_per_call<SlowClock>([] { SlowClock::now += 700; }), 700e-9);
  EXPECT_DOUBLE_EQ(seconds_of<SlowClock>([] {}), 1e-9);  // the least that it returns
  StopwatchOf<SlowClock> watch;
  watch.charge(0);
  SlowClock::now += 30;
  watch.charge(decltype(watch)::stopped);
  EXPECT_DOUBLE_EQ(watch.seconds(0), 30e-9);
}

}  // namespace
}  // namespace kds::stopwatch_test
