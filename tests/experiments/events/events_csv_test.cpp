#include "experiments/events/event_files.h"

#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/events/event_distribution.h"

namespace kds::events_csv_test {
namespace {

// Returns the CSV of three steps of two structures, or of the first structure only.
std::string csv_of(bool timed, const std::vector<FrameStamp>& frames, bool both) {
  std::ostringstream text;
  EventsCsv csv(text, timed);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    csv.add(frames[k], "wrapped", k + 1);
    if (both) csv.add(frames[k], "power", std::array{10U, 0U, 20U}[k]);
  }
  return text.str();
}

TEST(EventsCsv, HasOneLineForEachFrameAndStructure) {
  EXPECT_EQ(csv_of(false, {{0, {}}, {1, {}}, {2, {}}}, true),
            "frame,structure,events,cumulative\n"
            "0,wrapped,1,1\n"
            "0,power,10,10\n"
            "1,wrapped,2,3\n"
            "1,power,0,10\n"
            "2,wrapped,3,6\n"
            "2,power,20,30\n");
}

TEST(EventsCsv, NamesFramesByTheirNumberInTheFileAndTellsTheirTimes) {
  EXPECT_EQ(csv_of(false, {{100, {}}, {110, {}}, {120, {}}}, false),
            "frame,structure,events,cumulative\n100,wrapped,1,1\n110,wrapped,2,3\n120,wrapped,3,6\n");
  EXPECT_EQ(csv_of(true, {{100, 2.0}, {110, 2.2}, {120, 2.4}}, false),
            "frame,structure,events,cumulative,picoseconds\n"
            "100,wrapped,1,1,2\n110,wrapped,2,3,2.2\n120,wrapped,3,6,2.4\n");
}

TEST(EventsCsv, IsAHeaderWithoutSteps) {
  EXPECT_EQ(csv_of(false, {}, true), "frame,structure,events,cumulative\n");
}

TEST(EventBins, HoldEveryStepOnce) {
  EventCourse course(2);
  for (const std::uint64_t events : {1U, 2U, 3U, 4U, 5U}) course.add(events, {10 * course.steps(), {}});
  EXPECT_EQ(course.steps(), 5U);
  const auto& bins = course.bins();
  ASSERT_EQ(bins.size(), 3U);
  EXPECT_EQ(bins[0].events, 3U);
  EXPECT_EQ(bins[1].first_frame.number, 20U);
  EXPECT_EQ(bins[2].events, 5U);
  EXPECT_TRUE(EventCourse(1).bins().empty());
}

TEST(EventBins, AreNeverMoreThanAskedFor) {
  for (const std::size_t steps : {0U, 1U, 599U, 600U, 601U, 1200U, 1201U, 1000000U}) {
    const std::size_t width = bin_width(steps, 600);
    EXPECT_GE(width, 1U);
    EXPECT_LE((steps + width - 1) / width, 600U) << steps;
  }
}

}  // namespace
}  // namespace kds::events_csv_test
