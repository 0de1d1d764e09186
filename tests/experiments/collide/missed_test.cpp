// Tests `kds missed`: its options, its counts and its files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/collide/missed_command.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::missed_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MissedOptions, DefaultsAndAll) {
  const MissedTask plain = parse_missed_options({"a.pdb", "--cutoff", "8"}).task;
  EXPECT_THAT(plain.strides, IsEmpty());
  EXPECT_THAT(plain.factors, ElementsAre(1));
  EXPECT_EQ(plain.apart, 2U);
  EXPECT_EQ(plain.motion, FrameMotion::linear);
  const MissedOptions all =
      parse_missed_options({"a.xyz", "--strides", "8,1", "--factors", "2.5,2.2", "--apart", "5", "--motion",
                            "hermite", "--out", "there", "--json", "-", "--quiet"});
  EXPECT_THAT(all.task.strides, ElementsAre(1, 8));
  EXPECT_THAT(all.task.factors, ElementsAre(2.2, 2.5));
  EXPECT_EQ(all.task.apart, 5U);
  EXPECT_EQ(all.task.motion, FrameMotion::hermite);
  EXPECT_EQ(all.destinations.out, "there");
  EXPECT_EQ(all.destinations.json, "-");
  EXPECT_TRUE(all.destinations.quiet);
}

// A bead moves past a bead at rest from x = -9 to 9, comes back for frames 2 and 3, and leaves.
struct Passing {
  ScratchDirectory directory;
  std::string rests = directory.file("rests.xyz", "1\n\nC 0 0 0\n");
  std::string passes =
      directory.file("passes.xyz", "1\n\nC -9 0 0\n1\n\nC 9 0 0\n1\n\nC 0 0 0\n1\n\nC 0 0 0\n1\n\nC 9 0 0\n");

  ProgramRun run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"missed", rests, passes, "--radius", "1"});
    return run_program(options);
  }
};

std::vector<int> column(const Json& rows, const char* name) {
  std::vector<int> numbers;
  for (const Json& row : rows) numbers.push_back(row[name]);
  return numbers;
}

TEST(Missed, CountsContactsInWhichNoFrameLies) {
  const Passing passing;
  const ProgramRun run = passing.run({"--json", "-", "--factors", "1"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["input"]["beads"], 2);
  EXPECT_EQ(json["input"]["frames"], 5);
  EXPECT_EQ(json["settings"]["apart"], 2);
  EXPECT_TRUE(json.contains("machine") && json.contains("version"));
  const Json& rows = json["rows"];
  EXPECT_THAT(column(rows, "stride"), ElementsAre(1, 2, 4));  // stride 8 would leave only one frame
  EXPECT_THAT(column(rows, "frames"), ElementsAre(5, 3, 2));
  EXPECT_THAT(column(rows, "contacts"), ElementsAre(2, 2, 2));
  EXPECT_THAT(column(rows, "found"), ElementsAre(1, 1, 0));
  EXPECT_THAT(column(rows, "missed"), ElementsAre(1, 1, 2));
  EXPECT_EQ(rows[2]["missed_fraction"], 1.0);
}

TEST(Missed, ARunAFactor) {
  const Passing passing;
  const ProgramRun run = passing.run({"--json", "-", "--factors", "0.5,10", "--strides", "4"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["input"]["radius_max"], 1.0);
  // With factor 10 the beads are in contact throughout.
  EXPECT_THAT(column(json["rows"], "contacts"), ElementsAre(2, 1));
  EXPECT_THAT(column(json["rows"], "found"), ElementsAre(0, 1));
}

TEST(Missed, ARunACutoff) {
  const Passing passing;
  const ProgramRun run = passing.run({"--json", "-", "--cutoff", "20,1", "--strides", "4"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_THAT(column(json["rows"], "cutoff"), ElementsAre(1, 20));
  EXPECT_FALSE(json["rows"][0].contains("factor"));
  EXPECT_THAT(column(json["rows"], "contacts"), ElementsAre(2, 1));
  EXPECT_THAT(column(json["rows"], "found"), ElementsAre(0, 1));
  // Between surfaces, both radii of 1 are added.
  const Json surface = Json::parse(passing.run({"--json", "-", "--cutoff", "18", "--surface"}).out);
  EXPECT_THAT(column(surface["rows"], "contacts"), ElementsAre(1, 1, 1));
  EXPECT_THAT(passing.run({"--cutoff", "1"}).out, HasSubstr("cutoff"));
}

TEST(Missed, WithoutContactsNoShare) {
  const ScratchDirectory directory;
  const std::string path = directory.file("two.xyz", "2\n\nC 0 0 0\nC 1 0 0\n2\n\nC 0 0 0\nC 1 0 1\n");
  const ProgramRun run = run_program({"missed", path, "--json", "-", "--factors", "1"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  ASSERT_EQ(json["rows"].size(), 1U);
  EXPECT_EQ(json["rows"][0]["contacts"], 0);
  EXPECT_EQ(json["rows"][0]["missed_fraction"], nullptr);
}

// Shares of 60 steps have intervals. At stride 1 no contact is missed, so that share has no interval.
TEST(Missed, SharesOfManyStepsHaveIntervals) {
  const std::string villin = data_file("trajectories/villin_hp36_300K");
  const ProgramRun run =
      run_program({"missed", villin + ".dcd", "--topology", villin + ".pdb", "--frames", ":61", "--factors",
                   "2.5", "--apart", "5", "--strides", "1,4", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json rows = Json::parse(run.out)["rows"];
  EXPECT_EQ(rows[0]["missed"], 0);
  EXPECT_EQ(rows[0]["missed_fraction_lower"], nullptr);
  const double share = rows[1]["missed_fraction"];
  EXPECT_GT(share, 0);
  EXPECT_LT(rows[1]["missed_fraction_lower"], share);
  EXPECT_GT(rows[1]["missed_fraction_lower"], 0.5 * share);
  EXPECT_GT(rows[1]["missed_fraction_upper"], share);
  EXPECT_LT(rows[1]["missed_fraction_upper"], 2 * share);
}

TEST(Missed, WritesFilesAndAPage) {
  const Passing passing;
  const std::string out = (passing.directory / "report").string();
  ProgramRun run = passing.run({"--out", out, "--factors", "1"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("missed %"));
  EXPECT_THAT(
      content_of(passing.directory / "report/missed.csv"),
      testing::StartsWith("factor,stride,frames,contacts,found,missed,missed_fraction,missed_fraction_lower,"
                          "missed_fraction_upper\n1,1,5,2,1,1,0.5,,\n"));
  const Json json = Json::parse(content_of(passing.directory / "report/missed.json"));
  EXPECT_EQ(json["rows"].size(), 3U);
  EXPECT_EQ(ReportData(passing.directory / "report/report.html").result, json);
}

}  // namespace
}  // namespace kds::test::missed_test
