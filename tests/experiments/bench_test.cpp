// `kds bench`, through the library and from outside.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/bench_chains.h"
#include "experiments/bench_report.h"
#include "experiments/command_line.h"
#include "tests/experiments/run_program.h"

namespace kds {
namespace {

using Json = nlohmann::ordered_json;

TEST(BenchChains, EveryBeadMovesByTheDistance) {
  const Eigen::Matrix3Xd start = model_at_rest("random-chain", 50);
  ASSERT_EQ(start.cols(), 50);
  const std::vector<Eigen::Matrix3Xd> frames = jostled_frames(start, 0.01, 4);
  ASSERT_EQ(frames.size(), 4U);
  for (std::size_t k = 1; k < frames.size(); ++k) {
    for (Eigen::Index b = 0; b < start.cols(); ++b)
      EXPECT_NEAR((frames[k].col(b) - frames[k - 1].col(b)).norm(), 0.01, 1e-12);
  }
  EXPECT_EQ(frames, jostled_frames(start, 0.01, 4));  // the same again
}

TEST(BenchReport, RatioGoalAndWhatHolds) {
  const BenchRow held{"a", "x", 3, 2, "ns", "peer", 10, 0.25}, missed{"b", "x", 3, 4, "ns", "peer", 10, 0.25},
      alone{"c", "x", 3, 4, "ns", "", std::nullopt, 3}, free{"d", "x", 3, 4, "ns", "peer", 8, std::nullopt};
  EXPECT_EQ(held.holds(), true);
  EXPECT_EQ(missed.holds(), false);
  EXPECT_EQ(alone.holds(), false);
  EXPECT_EQ(free.holds(), std::nullopt);
  const Json json = Json::parse(bench_json(std::array{held, missed, alone, free}));
  EXPECT_EQ(json["rows"][0]["ratio"], 0.2);
  EXPECT_EQ(json["rows"][2]["ratio"], nullptr);
  EXPECT_EQ(json["rows"][2]["peer"], nullptr);
  EXPECT_EQ(json["rows"][3]["goal"], nullptr);
  EXPECT_EQ(json["rows"][3]["holds"], nullptr);
  EXPECT_THAT(bench_csv(std::array{held}), testing::HasSubstr("a,x,3,2,ns,peer,10,0.2,0.25,true"));
}

TEST(Bench, HierarchiesGiveARowForEachMeasureAndInput) {
  const test::ProgramRun result =
      test::run_program({"bench", "hierarchies", "--sizes", "40,64", "--trajectories",
                         test::data_file("trajectories/villin_hp36_300K.dcd"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_TRUE(json.contains("machine"));
  EXPECT_TRUE(json.contains("version"));
  std::set<std::string> names, inputs;
  for (const Json& row : json["rows"]) {
    names.insert(row["name"]);
    inputs.insert(row["input"]);
    EXPECT_GT(row["value"].get<double>(), 0);
    if (!row["peer_value"].is_null()) {
      EXPECT_DOUBLE_EQ(row["ratio"].get<double>(),
                       row["value"].get<double>() / row["peer_value"].get<double>());
    }
    if (!row["goal"].is_null()) {
      const double judged = row["ratio"].is_null() ? row["value"].get<double>() : row["ratio"].get<double>();
      EXPECT_EQ(row["holds"].get<bool>(), judged <= row["goal"].get<double>());
    }
  }
  EXPECT_EQ(names.size(), 7U);
  EXPECT_EQ(inputs.size(), 9U);  // four inputs, equal and unequal radii, and the query
}

TEST(Bench, PowerGivesARowForEachTechniqueAndInput) {
  const test::ProgramRun result =
      test::run_program({"bench", "power", "--sizes", "64", "--trajectories",
                         test::data_file("trajectories/villin_hp36_300K.dcd"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  std::set<std::string> names, inputs, goals;
  for (const Json& row : json["rows"]) {
    names.insert(row["name"]);
    inputs.insert(row["input"]);
    EXPECT_GT(row["value"].get<double>(), 0);
    EXPECT_EQ(row["unit"], "us/frame");
    EXPECT_DOUBLE_EQ(row["ratio"].get<double>(),
                     row["value"].get<double>() / row["peer_value"].get<double>());
    if (!row["goal"].is_null()) goals.insert(row["name"]);
  }
  EXPECT_THAT(names, testing::ElementsAre("activate", "auto to best", "auto to rebuild", "greedy", "kinetic",
                                          "lifted", "reinsert"));
  EXPECT_THAT(goals, testing::ElementsAre("auto to best", "auto to rebuild", "kinetic"));
  EXPECT_EQ(inputs.size(), 8U);  // four strides, four chains
}

TEST(Bench, RefusesWhatItDoesNotKnow) {
  for (const Arguments& arguments :
       {Arguments{"bench"}, Arguments{"bench", "spheres"}, Arguments{"bench", "hierarchies", "--sizes", "1"},
        Arguments{"bench", "hierarchies", "--rounds", "4"}, Arguments{"bench", "power", "--sizes", "3"},
        Arguments{"bench", "power", "hierarchies"},
        Arguments{"bench", "hierarchies", "--sizes", "10", "--trajectories", "none.dcd"}}) {
    const test::ProgramRun result = test::run_program(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace kds
