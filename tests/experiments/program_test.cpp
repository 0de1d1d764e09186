// The program from outside: exit codes, one line for each mistake, and where results go.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");

// Exit code 2, nothing on standard output, one line on standard error that has each of the words.
void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.code, 2) << testing::PrintToString(arguments) << "\n" << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(run.err.starts_with("kds: ") && run.err.ends_with("\n")) << run.err;
  for (const std::string& word : words) EXPECT_THAT(run.err, HasSubstr(word));
}

std::string xyz(const std::vector<std::string>& beads) {
  std::string frame = std::to_string(beads.size()) + "\nframe\n";
  for (const std::string& bead : beads) frame += "C " + bead + "\n";
  return frame;
}

TEST(Program, HelpAndVersionSucceed) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"-h"}, {"--version"}, {"run", "--help"}, {"replay", "--help"}}) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, HasSubstr("kds"));
  }
}

TEST(Program, RefusesWrongUsage) {
  expect_refused({}, {"no command"});
  expect_refused({"fly"}, {"unknown command 'fly'"});
  expect_refused({"two\nlines"}, {"unknown command"});
  expect_refused({"--fly"}, {"unknown option '--fly'"});
  expect_refused({"run"}, {"INPUT"});
  expect_refused({"run", kSmall, "--fly"}, {"unknown option '--fly'"});
  expect_refused({"run", kSmall, "--kernel", "slow"}, {"--kernel", "slow"});
  expect_refused({"run", kSmall, "--structures", "contacts"}, {"not available yet"});
  expect_refused({"replay"}, {"one LOG"});
  expect_refused({"replay", kSmall, kSmall}, {"one LOG"});
}

TEST(Program, RefusesMissingFiles) {
  const ScratchDirectory directory;
  const std::string missing = (directory / "missing.pdb").string();
  expect_refused({"run", missing}, {"missing.pdb"});
  expect_refused({"run", kSmall, missing}, {"missing.pdb"});
  expect_refused({"run", directory.file("a.dcd", ""), "--topology", missing}, {"missing.pdb"});
  expect_refused({"replay", missing}, {"missing.pdb"});
  expect_refused({"run", missing, "--out", (directory / "report").string()}, {"missing.pdb"});
  EXPECT_FALSE(std::filesystem::exists(directory / "report"));
}

TEST(Program, RefusesOutputsBeforeTheRun) {
  const ScratchDirectory directory;
  const std::string file = directory.file("taken", "precious");
  const std::string nowhere = (directory / "no/such").string();
  expect_refused({"run", kSmall, "--out", file}, {"--out", "taken"});
  expect_refused({"run", kSmall, "--dump", file}, {"--dump", "taken"});
  expect_refused({"run", kSmall, "--json", nowhere}, {"--json", "no/such"});
  expect_refused({"run", kSmall, "--log", nowhere}, {"--log", "no/such"});
  expect_refused({"run", kSmall, "--json", file, "--log", file}, {"--log", "taken", "--json"});
  EXPECT_EQ(content_of(file), "precious");
}

TEST(Program, NeverOverwritesItsInput) {
  const ScratchDirectory directory;
  const std::string input = directory.file("two.xyz", xyz({"0 0 0", "1 0 0"}) + xyz({"0 0 0", "2 0 0"}));
  const std::string before = content_of(input);
  expect_refused({"run", input, "--json", input}, {"--json", "input"});
  expect_refused({"run", input, "--log", (directory / "." / "two.xyz").string()}, {"--log", "input"});
  EXPECT_EQ(content_of(input), before);
}

TEST(Program, RefusesBrokenFiles) {
  const ScratchDirectory directory;
  const std::string good = xyz({"0 0 0", "1 0 0", "2 0.5 0"});
  expect_refused({"run", directory.file("nan.xyz", good + xyz({"0 0 0", "nan 0 0", "2 0 0"}))},
                 {"nan.xyz", "frame 1"});
  expect_refused({"run", directory.file("count.xyz", good + xyz({"0 0 0", "1 0 0"}))},
                 {"count.xyz", "frame 1"});
  expect_refused({"run", directory.file("cut.xyz", good + good + "3\nframe\nC 0 0")}, {"cut.xyz", "frame"});
  expect_refused({"run", directory.file("one-frame.xyz", good)}, {"one-frame.xyz"});
  expect_refused({"run", directory.file("empty.xyz", "")}, {"empty.xyz"});
  expect_refused({"run", directory.file("what.bin", "?")}, {"what.bin"});
}

TEST(Program, RefusesATrajectoryThatEndsInsideAFrame) {
  const ScratchDirectory directory;
  std::string bytes = content_of(data_file("trajectories/villin_hp36_300K.dcd"));
  ASSERT_GT(bytes.size(), 100000U);
  bytes.resize(100000);
  expect_refused({"run", directory.file("cut.dcd", bytes)}, {"cut.dcd", "frame"});
}

TEST(Program, RefusesAnEmptySelection) {
  const std::string model = data_file("trajectories/villin_hp36_300K.pdb");
  expect_refused(
      {"run", data_file("trajectories/villin_hp36_300K.dcd"), "--topology", model, "--chain", "nobody"},
      {"nobody"});
}

TEST(Program, OneBeadAndTwoInOnePlaceRunOrAreRefused) {
  const ScratchDirectory directory;
  const std::string one = directory.file("one.xyz", xyz({"0 0 0"}) + xyz({"1 0 0"}));
  const std::string twins =
      directory.file("twins.xyz", xyz({"0 0 0", "0 0 0", "1 1 0", "2 0 1", "3 1 1"}) +
                                      xyz({"0 0 0", "0 0 0", "1 1 1", "2 0 1", "3 2 1"}));
  for (const std::string& input : {one, twins}) {
    const ProgramRun run = run_program({"run", input, "--radius", "0.5", "--audit", "frames"});
    if (run.code == 0) continue;
    EXPECT_EQ(run.code, 2) << run.err;  // what is not solved ends in one clear line
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

TEST(Program, StandardOutputHoldsWhatWasAskedFor) {
  const ProgramRun table = run_program({"run", kSmall});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("fingerprint "));
  EXPECT_EQ(table.err, "");  // no progress bar: standard error is no terminal

  EXPECT_EQ(run_program({"run", kSmall, "--quiet"}).out, "");

  const ProgramRun json = run_program({"run", kSmall, "--json", "-"});
  EXPECT_EQ(json.code, 0);
  const Json summary = Json::parse(json.out);
  EXPECT_EQ(summary["structures"]["sorted"]["events"]["total"], 97);
  EXPECT_THAT(table.out, HasSubstr(summary["fingerprint"].get<std::string>()));
  EXPECT_EQ(Json::parse(run_program({"run", kSmall, "--json", "-", "--quiet"}).out)["fingerprint"],
            summary["fingerprint"]);
}

TEST(Program, WritesItsReport) {
  const ScratchDirectory directory;
  const std::string report = (directory / "a/report").string();
  const ProgramRun run =
      run_program({"run", kSmall, "--out", report, "--json", (directory / "copy.json").string()});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr(report + "/report.html"));
  const std::string summary = content_of(report + "/summary.json");
  EXPECT_EQ(summary, content_of(directory / "copy.json"));
  EXPECT_EQ(Json::parse(summary)["input"]["beads"], 20);
  EXPECT_EQ(content_of(report + "/events.csv"), "frame,structure,events,cumulative\n0,sorted,97,97\n");
  EXPECT_THAT(content_of(report + "/report.html"), HasSubstr("</html>"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(report), {}), 3);
}

TEST(Program, ReplaysItsLog) {
  const ScratchDirectory directory;
  const std::string log = (directory / "events.log").string();
  ASSERT_EQ(run_program({"run", kSmall, "--log", log, "--quiet"}).code, 0);
  const ProgramRun same = run_program({"replay", log});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("fingerprint same"));
  const ProgramRun json = run_program({"replay", log, "--json", "-"});
  EXPECT_EQ(Json::parse(json.out)["replay"]["same"], true);
  EXPECT_EQ(run_program({"replay", log, "--quiet"}).out, "");
  expect_refused({"replay", directory.file("other.log", "not a log\n")}, {"other.log"});
}

TEST(Program, AClosedOrFullOutputIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const ProgramRun run = run_program({"run", kSmall, "--quiet", "--json", "/dev/full"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("/dev/full"));
  EXPECT_THAT(run.err, Not(HasSubstr("terminate")));
}

}  // namespace
}  // namespace kds::test
