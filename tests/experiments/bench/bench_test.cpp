// Tests `kds bench`, through the library and as a process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/bench_report.h"
#include "experiments/program/command_line.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::bench_test {
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
  EXPECT_EQ(frames, jostled_frames(start, 0.01, 4));  // deterministic
}

TEST(BenchChains, PlanarOnesStayInThePlane) {
  for (const Eigen::Matrix3Xd& start : {planar_spiral(300), model_at_rest("grid", 300, 0.5, 2)})
    for (const Eigen::Matrix3Xd& frame : jostled_frames(start, 0.1, 3, 2)) {
      EXPECT_EQ(frame.row(2).cwiseAbs().maxCoeff(), 0);
      EXPECT_GT((frame.rowwise().maxCoeff() - frame.rowwise().minCoeff()).head(2).minCoeff(), 10);
    }
}

TEST(BenchReport, RatioGoalAndWhatHolds) {
  const BenchRow held{"a", "x", 3, 2, "ns", "peer", 10, 0.25}, missed{"b", "x", 3, 4, "ns", "peer", 10, 0.25},
      alone{"c", "x", 3, 4, "ns", "", std::nullopt, 3}, free{"d", "x", 3, 4, "ns", "peer", 8, std::nullopt},
      in_ns{"e", "x", 3, 4, "ns", "peer", 1, 5, true}, nothing{"f", "x", 3, 4, "ns", "peer", 0, std::nullopt};
  EXPECT_EQ(in_ns.holds(), true);
  EXPECT_EQ(in_ns.ratio(), 4);
  EXPECT_EQ(nothing.ratio(), std::nullopt);
  EXPECT_EQ(held.holds(), true);
  EXPECT_EQ(missed.holds(), false);
  EXPECT_EQ(alone.holds(), false);
  EXPECT_EQ(free.holds(), std::nullopt);
  const Json json =
      Json::parse(bench_json("kds bench engine", {{"rounds", 5}}, std::array{held, missed, alone, free}));
  EXPECT_EQ(json["command"], "kds bench engine");
  EXPECT_EQ(json["settings"]["rounds"], 5);
  EXPECT_EQ(json["rows"][0]["ratio"], 0.2);
  EXPECT_EQ(json["rows"][2]["ratio"], nullptr);
  EXPECT_EQ(json["rows"][2]["peer"], nullptr);
  EXPECT_EQ(json["rows"][3]["goal"], nullptr);
  EXPECT_EQ(json["rows"][3]["holds"], nullptr);
  EXPECT_THAT(bench_csv(std::array{held}), testing::HasSubstr("a,x,3,2,ns,peer,10,0.2,0.25,true,,\n"));
  const BenchRow comma{"a, an event", "x", 3, 2, "ns", "", std::nullopt, std::nullopt};
  EXPECT_THAT(bench_csv(std::array{comma}), testing::HasSubstr("\n\"a, an event\",x,3,2,ns,,,,,,,\n"));
}

TEST(BenchReport, TimesHaveTheirSpread) {
  const BenchRow row = with_spread({"a", "x", 3, 2000, "ns", "peer", 8000, 0.5}, {3e-6, 1e-6, 2e-6}, 1e9);
  const Json json = Json::parse(bench_json("kds bench engine", {}, std::array{row}));
  EXPECT_DOUBLE_EQ(json["rows"][0]["value_least"], 1000);
  EXPECT_DOUBLE_EQ(json["rows"][0]["value_most"], 3000);
  const std::string page = bench_page("engine", std::array{row}, {});
  test::expect_sound(page);
  EXPECT_THAT(
      page, testing::HasSubstr("<p><strong>1</strong> of 1 goal reached, in 1 measure of engine. At best, "));
  EXPECT_THAT(page, testing::HasSubstr("<td>2,000 <small>(1,000 to 3,000)</small></td>"));
  EXPECT_THAT(page, testing::HasSubstr("a, x\nn: 3\nours / peer: 0.25"));
}

TEST(BenchReport, ColumnsOfTheTableAreAligned) {
  const BenchRow tidy{"a", "x", 3, 2, "ns", "peer", 10, 0.25}, wide{"a name of more than twenty-four letters",
                                                                    "an input of more than thirty letters",
                                                                    1234567,
                                                                    1.234e-10,
                                                                    "events/step",
                                                                    "",
                                                                    std::nullopt,
                                                                    std::nullopt};
  const std::string table = bench_table(std::array{tidy, wide});
  std::array<std::string, 3> lines;
  std::istringstream in(table);
  for (std::string& line : lines) std::getline(in, line);
  for (const char* left : {"input", "unit", "holds"}) {
    const std::size_t column = lines[0].find(left);
    for (const std::string& line : lines) {
      EXPECT_EQ(line[column - 1], ' ') << line;
      EXPECT_NE(line[column], ' ') << line;
    }
  }
  EXPECT_EQ(lines[0].find("value") + 5, lines[2].find("1.234e-10") + 9);
  EXPECT_THAT(table, testing::Not(testing::HasSubstr(" \n")));
}

TEST(Bench, HierarchiesGiveARowForEachMeasureAndInput) {
  const test::ProgramRun result =
      test::run_program({"bench", "hierarchies", "--sizes", "40,64", "--trajectories",
                         test::data_file("trajectories/villin_hp36_300K.dcd"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["settings"]["trajectories"], Json::array({"villin_hp36_300K.dcd"}));  // no folder
  EXPECT_TRUE(json.contains("machine"));
  EXPECT_TRUE(json.contains("version"));
  std::set<std::string> names, inputs;
  for (const Json& row : json["rows"]) {
    names.insert(row["name"]);
    inputs.insert(row["input"]);
    // With so few beads, a few steps may have no event.
    EXPECT_GE(row["value"].get<double>(), row["unit"] == "events/step" ? 0 : 1e-9);
    EXPECT_EQ(row["ratio"].is_null(), row["peer_value"].is_null() || row["peer_value"] == 0);
    if (!row["ratio"].is_null()) {
      EXPECT_DOUBLE_EQ(row["ratio"].get<double>(),
                       row["value"].get<double>() / row["peer_value"].get<double>());
    }
    if (!row["goal"].is_null()) {
      const double judged = row["ratio"].is_null() ? row["value"].get<double>() : row["ratio"].get<double>();
      EXPECT_EQ(row["holds"].get<bool>(), judged <= row["goal"].get<double>());
    }
  }
  for (const Json& row : json["rows"]) {
    EXPECT_EQ(row["value_least"].is_null(), row["unit"] == "events/step");
    if (row["value_least"].is_null()) continue;
    EXPECT_LE(row["value_least"], row["value"]);
    EXPECT_LE(row["value"], row["value_most"]);
  }
  EXPECT_EQ(names.size(), 12U);
  EXPECT_EQ(inputs.size(), 14U);  // six inputs, equal and unequal radii, a query, a rotation
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
    EXPECT_LE(row["value_least"], row["value"]);
    EXPECT_LE(row["value"], row["value_most"]);
    EXPECT_DOUBLE_EQ(row["ratio"].get<double>(),
                     row["value"].get<double>() / row["peer_value"].get<double>());
    if (!row["goal"].is_null()) goals.insert(row["name"]);
  }
  EXPECT_THAT(names, testing::ElementsAre("activate", "auto to best", "auto to rebuild", "greedy", "kinetic",
                                          "lifted", "regular", "reinsert"));
  EXPECT_THAT(goals, testing::ElementsAre("auto to best", "auto to rebuild", "kinetic", "regular"));
  EXPECT_EQ(inputs.size(), 14U);  // four strides, six chains, four regular scenes
}

TEST(Bench, CollisionGivesARowForEachDetectorMotionAndInput) {
  const test::ProgramRun result =
      test::run_program({"bench", "collision", "--sizes", "64", "--trajectories",
                         test::data_file("trajectories/villin_hp36_300K.dcd"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const Json json = Json::parse(result.out);
  std::set<std::string> names, inputs, peers;
  for (const Json& row : json["rows"]) {
    names.insert(row["name"]);
    inputs.insert(row["input"]);
    peers.insert(row["peer"]);
    EXPECT_EQ(row["unit"], "ns/bead");
    EXPECT_LE(row["value_least"], row["value"]);
    EXPECT_LE(row["value"], row["value_most"]);
    EXPECT_GT(row["value"].get<double>(), 0);
    // Contacts have a goal only on other trajectories, and growth has one only from 100,000 beads on.
    const std::string name = row["name"];
    ASSERT_EQ(row["goal"].is_null(),
              name.starts_with("contacts, ") || name.ends_with(", ten times the beads"));
    if (!row["goal"].is_null()) {
      EXPECT_EQ(row["holds"].get<bool>(), row["ratio"] <= row["goal"]);
    }
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"frame auto, 0.003 r a frame", "frame auto, 0.03 r a frame",
                                            "frame auto, 0.3 r a frame", "frame auto, as simulated",
                                            "frame auto, declared speed", "frame auto, distant necklaces",
                                            "static auto, ten times the beads"}));
  EXPECT_THAT(inputs, testing::IsSupersetOf({"helix", "scaling-helix", "packed", "rotated packed",
                                             "random-chain", "spline", "villin_hp36_300K"}));
  EXPECT_THAT(peers, testing::IsSupersetOf({"cell list", "Verlet list", "reading the positions"}));
}

TEST(Bench, CertificatesGiveARowEachWithTheGoalsThatThereAre) {
  const test::ProgramRun result = test::run_program(
      {"bench", "certificates", "--instances", test::data_file("kinetic"), "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  std::set<std::string> names, goals;
  for (const Json& row : json["rows"]) {
    names.insert(row["name"]);
    EXPECT_GT(row["value"].get<double>(), 0);
    EXPECT_EQ(row["unit"], "ns");
    EXPECT_LE(row["value_least"], row["value"]);
    EXPECT_LE(row["value"], row["value_most"]);
    EXPECT_EQ(row["peer"].is_null(), row["ratio"].is_null());
    if (row["goal"].is_null()) continue;
    goals.insert(row["name"]);
    const bool of_ratio = row["name"].get<std::string>().starts_with("exact/");
    EXPECT_EQ(row["holds"].get<bool>(), row[of_ratio ? "ratio" : "value"] <= row["goal"]);
  }
  EXPECT_EQ(names.size(), json["rows"].size());
  EXPECT_THAT(goals,
              testing::ElementsAre("compare/facet/linear", "exact/isolation/facet/cubic",
                                   "exact/isolation/facet/linear", "failure/facet/linear",
                                   "settle/facet/cells/linear", "settle/facet/cells/linear/any_processor",
                                   "tolerance/facet/linear/0.0001r", "tolerance/facet/linear/0.001r"));
}

TEST(Bench, EngineRunsEveryInstanceOfAFolder) {
  const test::ScratchDirectory directory;
  for (const char* name :
       {"d1_n20_linear.txt", "d2_n20_degree2.txt", "d3_n50_degree3.txt", "w3_n20_linear.txt"})
    std::filesystem::copy_file(test::data_file(std::string("kinetic/") + name), directory / name);
  const test::ProgramRun result = test::run_program(
      {"bench", "engine", "--instances", directory.path().string(), "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  std::set<std::string> inputs;
  std::size_t goals = 0;
  const Json json = Json::parse(result.out);
  for (const Json& row : json["rows"]) {
    inputs.insert(row["input"]);
    EXPECT_GT(row["value"].get<double>(), 0);
    goals += row["goal"].is_null() ? 0 : 1;
    EXPECT_EQ(row["unit"], row["peer"].is_null() || row["input"] == "random times" ? "ns" : "us");
  }
  EXPECT_EQ(json["rows"].size(), 14U);  // three instances, two kernels, an event and a run; two queues
  EXPECT_THAT(inputs,
              testing::ElementsAre("d1_n20_linear", "d2_n20_degree2", "d3_n50_degree3", "random times"));
  EXPECT_EQ(goals, 1U);
}

TEST(Bench, ReadersGiveTimeAndSpeedOfEachFile) {
  const test::ProgramRun result = test::run_program(
      {"bench", "readers", "--trajectories",
       test::data_file("formats/chain_and_gas.xtc") + "," + test::data_file("formats/nine_atoms.trr"),
       "--json", "-", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json rows = Json::parse(result.out)["rows"];
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < 4; i += 2) {
    EXPECT_EQ(rows[i]["unit"], "ns/atom");
    EXPECT_EQ(rows[i]["peer"], "reading the bytes");
    EXPECT_EQ(rows[i + 1]["unit"], "million atoms/s");
    EXPECT_NEAR(rows[i]["value"].get<double>() * rows[i + 1]["value"].get<double>(), 1000, 1e-6);
  }
  EXPECT_EQ(rows[0]["name"], "read xtc");
  EXPECT_EQ(rows[0]["n"], 2400);  // 600 atoms in 4 frames
  EXPECT_EQ(rows[0]["holds"].get<bool>(), rows[0]["value"].get<double>() <= 200);
  EXPECT_EQ(rows[2]["name"], "read trr");
  EXPECT_EQ(rows[2]["n"], 27);
  EXPECT_TRUE(rows[2]["goal"].is_null());
}

TEST(Bench, FindsItsDataFromAnyFolder) {
  const test::ScratchDirectory directory;
  const std::filesystem::path instances = directory / "kinetic";
  std::filesystem::create_directory(instances);
  std::filesystem::copy_file(test::data_file("kinetic/d1_n20_linear.txt"), instances / "d1_n20_linear.txt");
  const auto rows = [&](const std::string& line) {
    const test::ProgramRun run = test::run_shell("cd \"$1\" && \"$0\" " + line, {directory.path().string()});
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out)["rows"].size();
  };
  EXPECT_GT(rows("bench trade --json - --quiet"), 10U);
  EXPECT_EQ(rows("bench engine --data . --json - --quiet"), 6U);  // one instance, two kernels; two queues
}

TEST(Bench, RefusesWhatItDoesNotKnow) {
  for (const Arguments& arguments :
       {Arguments{"bench"}, Arguments{"bench", "spheres"}, Arguments{"bench", "hierarchies", "--sizes", "1"},
        Arguments{"bench", "hierarchies", "--rounds", "4"}, Arguments{"bench", "power", "--sizes", "3"},
        Arguments{"bench", "power", "hierarchies"}, Arguments{"bench", "engine", "--sizes", "100"},
        Arguments{"bench", "power", "--instances", "data"},
        Arguments{"bench", "engine", "--instances", "none"},
        Arguments{"bench", "certificates", "--instances", KDS_DATA_DIR},
        Arguments{"bench", "engine", "--instances", KDS_DATA_DIR},
        Arguments{"bench", "hierarchies", "--data", "none"}, Arguments{"bench", "engine", "--data", "none"},
        Arguments{"bench", "readers", "--sizes", "10"},
        Arguments{"bench", "readers", "--trajectories", test::data_file("formats/wide.f32")},
        Arguments{"bench", "hierarchies", "--sizes", "10", "--trajectories", "none.dcd"}}) {
    const test::ProgramRun result = test::run_program(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace kds::bench_test
