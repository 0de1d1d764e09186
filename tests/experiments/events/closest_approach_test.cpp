// The closest approach of two beads in a run is the minimum over all pairs and steps. If a run skips frames
// or straightens the motion, its interval must contain that minimum.

#include "experiments/events/closest_approach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "structures/closest/least_distance.h"
#include "tests/experiments/run_program.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::test::closest_approach_test {
namespace {

using Json = nlohmann::ordered_json;

const std::string dcd = data_file("trajectories/villin_hp36_300K.dcd");

Json summary_of(const std::string& frames, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run", dcd,        "--structures", "sorted,closest", "--radius",
                                     "1",   "--frames", frames,         "--json",         "-"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return Json::parse(run.out);
}

DistanceRange range_of(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

/// Returns the minimum over all pairs in all steps.
DistanceRange least_of_all(const std::vector<Space>& steps) {
  DistanceRange least{HUGE_VAL, HUGE_VAL};
  for (const Space& step : steps) {
    for (BeadId b = 1; b < step.bead_count(); ++b) {
      for (BeadId a = 0; a < b; ++a) {
        const LeastDistance found = least_distance(Curves<3>(step), a, b);
        least.lower = std::min(least.lower, found.lower);
        least.upper = std::min(least.upper, found.upper);
      }
    }
  }
  return least;
}

TEST(ClosestApproach, IsThatOfAllPairs) {
  const std::vector<Space> steps = trajectory_steps("villin_hp36_300K.dcd", 0, 40);
  const Json found = summary_of("0:41")["closest_approach"];
  const DistanceRange least = least_of_all(steps), distance = range_of(found["distance"]);
  EXPECT_NEAR(distance.lower, least.lower, 1e-9);
  EXPECT_NEAR(distance.upper, least.upper, 1e-9);
  EXPECT_FALSE(found.contains("distance_in_all_frames"));
  const LeastDistance of_pair =
      least_distance(Curves<3>(steps.at(found["frame"])), found["beads"][0], found["beads"][1]);
  EXPECT_NEAR(of_pair.upper, least.upper, 1e-9);
  EXPECT_NEAR(of_pair.at, found["u"].get<double>(), 1e-3);
}

TEST(ClosestApproach, IntervalsHoldThatOfAllFrames) {
  const DistanceRange truth = range_of(summary_of("0:161")["closest_approach"]["distance"]);
  for (const auto& [frames, more] :
       {std::pair<std::string, std::vector<std::string>>{"0:161:2", {"--certify"}},
        {"0:161:16", {"--certify"}},
        {"0:161:4", {"--certify", "--motion", "hermite"}},
        {"0:161", {"--tolerance", "0.2r"}},
        {"0:161:2", {"--certify", "--tolerance", "0.05"}}}) {
    SCOPED_TRACE(frames);
    const Json found = summary_of(frames, more)["closest_approach"];
    const DistanceRange interval = range_of(found["distance_in_all_frames"]),
                        own = range_of(found["distance"]);
    EXPECT_LE(interval.lower, truth.lower);
    EXPECT_GE(interval.upper, truth.upper);
    EXPECT_LT(interval.lower, own.lower);
    EXPECT_GT(interval.upper, own.upper);
  }
}

TEST(ClosestApproach, NothingIsSaidOfFramesThatNobodyLookedAt) {
  const Json found = summary_of("4:161:40", {"--tolerance", "0.001"})["closest_approach"];
  EXPECT_FALSE(found.contains("distance_in_all_frames"));
  EXPECT_EQ(found["frame"].get<int>() % 40, 4);
}

TEST(ClosestApproach, DeviationsAreAddedOutward) {
  const DistanceRange range = within_deviation({0.3, 0.3}, 0.1);
  EXPECT_LT(range.lower, 0.1);
  EXPECT_GT(range.upper, 0.5);
  EXPECT_NEAR(range.lower, 0.1, 1e-14);
  EXPECT_NEAR(range.upper, 0.5, 1e-14);
  EXPECT_EQ(within_deviation({0.3, 0.3}, 0.2).lower, 0);
  EXPECT_EQ(within_deviation({0.3, 0.3}, HUGE_VAL).lower, 0);
  EXPECT_EQ(within_deviation({0.3, 0.3}, HUGE_VAL).upper, HUGE_VAL);
}

}  // namespace
}  // namespace kds::test::closest_approach_test
