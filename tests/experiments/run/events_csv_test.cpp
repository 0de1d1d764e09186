#include "experiments/run/events_csv.h"

#include <gtest/gtest.h>

#include "experiments/run/event_bins.h"
#include "tests/experiments/sample_report.h"

namespace kds {
namespace {

TEST(EventsCsv, HasOneLineForEachFrameAndStructure) {
  EXPECT_EQ(events_csv(test::sample_report()),
            "frame,structure,events,cumulative\n"
            "0,wrapped,1,1\n"
            "0,power,10,10\n"
            "1,wrapped,2,3\n"
            "1,power,0,10\n"
            "2,wrapped,3,6\n"
            "2,power,20,30\n");
}

TEST(EventsCsv, NamesFramesByTheirNumberInTheFileAndTellsTheirTimes) {
  RunReport report = test::sample_report();
  report.structures.pop_back();
  report.frame_numbers = {100, 110, 120, 130};
  EXPECT_EQ(events_csv(report),
            "frame,structure,events,cumulative\n100,wrapped,1,1\n110,wrapped,2,3\n120,wrapped,3,6\n");
  report.times = {2, 2.2, 2.4, 2.6};
  EXPECT_EQ(events_csv(report),
            "frame,structure,events,cumulative,picoseconds\n"
            "100,wrapped,1,1,2\n110,wrapped,2,3,2.2\n120,wrapped,3,6,2.4\n");
}

TEST(EventsCsv, IsAHeaderWithoutSteps) { EXPECT_EQ(events_csv({}), "frame,structure,events,cumulative\n"); }

TEST(EventBins, HoldEveryStepOnce) {
  const std::vector<std::uint64_t> events{1, 2, 3, 4, 5};
  const auto bins = bin_events(events, 2);
  ASSERT_EQ(bins.size(), 3U);
  EXPECT_EQ(bins[0].events, 3U);
  EXPECT_EQ(bins[1].first_step, 2U);
  EXPECT_EQ(bins[1].cumulative, 10U);
  EXPECT_EQ(bins[2].steps, 1U);
  EXPECT_EQ(bins[2].events, 5U);
  EXPECT_EQ(bins[2].cumulative, 15U);
  EXPECT_TRUE(bin_events({}, 1).empty());
}

TEST(EventBins, AreNeverMoreThanAskedFor) {
  for (const std::size_t steps : {0U, 1U, 599U, 600U, 601U, 1200U, 1201U, 1000000U}) {
    const std::size_t width = bin_width(steps, 600);
    EXPECT_GE(width, 1U);
    EXPECT_LE((steps + width - 1) / width, 600U) << steps;
  }
}

}  // namespace
}  // namespace kds
