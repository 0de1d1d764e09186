#include "experiments/run/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/sample_report.h"

namespace kds::report_json_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

TEST(ReportJson, HasTheShapeOfTheContract) {
  RunReport report = test::sample_report();
  report.command_line = "kds run chain.pdb";
  const std::string text = report_json(report);
  const Json json = Json::parse(text);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_THAT(keys(json), ElementsAre("command", "input", "settings", "structures", "engine", "fingerprint",
                                      "version", "machine"));
  EXPECT_EQ(json["command"], "kds run chain.pdb");
  EXPECT_THAT(keys(json["input"]), ElementsAre("files", "beads", "frames", "dimension", "truncated",
                                               "radius_min", "radius_max", "length_unit"));
  EXPECT_THAT(keys(json["machine"]), ElementsAre("cpu", "cores", "os", "compiler"));
  EXPECT_EQ(json["input"]["files"], Json::array({"chain.pdb"}));
  EXPECT_EQ(json["input"]["radius_max"], 1.5);
  EXPECT_EQ(json["settings"]["kernel"], "filtered");
  EXPECT_THAT(keys(json["engine"]), ElementsAre("seconds", "listeners_seconds", "close_comparisons",
                                                "exact_work", "threads", "parts", "parts_run_again"));
  EXPECT_EQ(json["engine"]["seconds"], 0.125);
  EXPECT_EQ(json["engine"]["listeners_seconds"], 0.0625);
  EXPECT_EQ(json["engine"]["close_comparisons"], (Json{{"exact", 7}, {"ties", 2}}));
  EXPECT_EQ(json["engine"]["threads"], 1);
  EXPECT_EQ(json["engine"]["parts"], 1);
  EXPECT_EQ(json["engine"]["parts_run_again"], 0);
  EXPECT_EQ(json["fingerprint"], "0000000000abcdef");
  EXPECT_FALSE(json["version"].get<std::string>().empty());
}

TEST(ReportJson, KeepsTheOrderOfStructuresAndKinds) {
  const Json structures = Json::parse(report_json(test::sample_report()))["structures"];
  EXPECT_THAT(keys(structures), ElementsAre("wrapped", "power"));
  EXPECT_THAT(keys(structures["power"]),
              ElementsAre("events", "internal", "certificates", "stages", "seconds", "build_seconds",
                          "static_seconds", "rebuilds", "audits"));
  EXPECT_THAT(keys(structures["power"]["events"]), ElementsAre("total", "2-3", "3-2", "wander"));
  EXPECT_EQ(structures["power"]["events"]["total"], 30);
  EXPECT_EQ(structures["power"]["rebuilds"], 1);
  EXPECT_THAT(
      keys(structures["wrapped"]["certificates"]),
      ElementsAre("created", "never_failing", "cancelled", "failed", "touched", "peak", "per_bead_max"));
  EXPECT_EQ(structures["wrapped"]["certificates"]["never_failing"], 1234000);
  EXPECT_EQ(structures["wrapped"]["stages"]["isolation"], 234567);
  EXPECT_EQ(structures["wrapped"]["audits"], (Json{{"run", 4}, {"failed", 0}}));
}

TEST(ReportJson, DoublesReadBackExactly) {
  RunReport report = test::sample_report();
  report.radius_min = 0.1 + 0.2;
  report.structures[0].seconds = 1.0 / 3;
  const Json json = Json::parse(report_json(report));
  EXPECT_EQ(json["input"]["radius_min"], 0.1 + 0.2);
  EXPECT_EQ(json["structures"]["wrapped"]["seconds"], 1.0 / 3);
}

TEST(ReportJson, StaysValidWithOddNamesAndEmptyReports) {
  RunReport report = test::sample_report();
  report.files = {"quote\".pdb", "not\xffutf8.pdb", "line\nbreak"};
  EXPECT_EQ(Json::parse(report_json(report))["input"]["files"].size(), 3U);
  report.structures[0].seconds = std::numeric_limits<double>::quiet_NaN();
  report.structures[0].stages.clear();
  const Json json = Json::parse(report_json(report));
  EXPECT_TRUE(json["structures"]["wrapped"]["seconds"].is_null());
  EXPECT_TRUE(json["structures"]["wrapped"]["stages"].is_object());
  EXPECT_TRUE(Json::parse(report_json(RunReport{}))["structures"].is_object());
}

TEST(ReportJson, ReplayAddsItsVerdict) {
  ReplayReport replay{test::sample_report(), 0xabcdef, 36};
  Json json = Json::parse(replay_json(replay, "run.log"));
  EXPECT_EQ(json["replay"]["log"], "run.log");
  EXPECT_EQ(json["replay"]["events"], 36);
  EXPECT_EQ(json["replay"]["same"], true);
  replay.logged_fingerprint = 1;
  json = Json::parse(replay_json(replay, "run.log"));
  EXPECT_EQ(json["replay"]["same"], false);
  EXPECT_EQ(json["replay"]["logged_fingerprint"], "0000000000000001");
}

}  // namespace
}  // namespace kds::report_json_test
