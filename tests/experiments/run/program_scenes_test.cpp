// Tests the program as a process: the scenes that it runs, and their counts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_scenes_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");
const std::string kTrajectory = data_file("trajectories/villin_hp36_300K.dcd");

// A linear motion written with five control points per coordinate has other polynomials but the same events.
TEST(Program, RunsPolynomialsBeyondTheUsualDegrees) {
  const ScratchDirectory directory;
  std::mt19937 random(7);
  std::string linear = "8 3 1\n", quartic = "8 3 4\n";
  for (int number = 0; number < 8 * 3; ++number) {
    const int from = 4 * static_cast<int>(random() % 100), to = 4 * static_cast<int>(random() % 100);
    const char* end = number % 3 == 2 ? "\n" : " ";
    linear += std::to_string(from) + " " + std::to_string(to) + end;
    for (int k = 0; k <= 4; ++k) quartic += std::to_string(from + k * (to - from) / 4) + (k < 4 ? " " : end);
  }
  const std::string one = directory.file("linear.txt", linear);
  const std::string four = directory.file("quartic.txt", quartic);
  for (const char* structure : {"sorted", "power", "wrapped"}) {
    const auto result = [&](const std::string& file) {
      const ProgramRun run = run_program(
          {"run", file, "--structures", structure, "--quiet", "--json", "-", "--audit", "events"});
      EXPECT_EQ(run.code, 0) << run.err;
      return Json::parse(run.out);
    };
    const auto expected = result(one);
    const auto found = result(four);
    EXPECT_GT(expected["structures"][structure]["events"]["total"], 0);
    EXPECT_EQ(found["structures"][structure]["events"], expected["structures"][structure]["events"]);
    EXPECT_EQ(found["fingerprint"], expected["fingerprint"]);
  }
}

TEST(Program, BeadsThatKeepToAPlaneOfTwoAxesRunInTwoDimensions) {
  const ScratchDirectory directory;
  const std::string flat = directory.file("flat.xyz", xyz({"0 7 0", "1 7 0", "2 7 1", "3 7 0", "4 7 1"}) +
                                                          xyz({"0 7 1", "1 7 0", "2 7 2", "3 7 3", "4 7 2"}));
  const std::string radii = "file:" + directory.file("radii.txt", "0.5\n0.6\n0.5\n0.7\n0.6\n");
  for (const char* motion : {"linear", "hermite", "lifted"}) {
    const std::string structures = motion == std::string("lifted") ? "power" : "wrapped,power";
    for (const std::string& rule : {std::string("auto"), radii}) {
      SCOPED_TRACE(motion + (" " + rule));
      const ProgramRun run = run_program({"run", flat, "--structures", structures, "--motion", motion,
                                          "--radius", rule, "--audit", "events", "--dump", directory / "dump",
                                          "--replace", "--quiet", "--json", "-"});
      ASSERT_EQ(run.code, 0) << run.err;
      const Json result = Json::parse(run.out);
      EXPECT_EQ(result["input"]["dimension"], 2);
      EXPECT_GT(result["structures"]["power"]["events"]["total"], 0);
      EXPECT_EQ(content_of(directory / "dump/frame-1.power.csv").substr(0, 6), "a,b,c\n");
      if (motion != std::string("lifted")) {
        EXPECT_THAT(content_of(directory / "dump/frame-1.wrapped.csv"), HasSubstr(",7,"));
      }
    }
  }
}

// A bead comes from so far away that all its events lie within 2^-200 of the step.
TEST(Program, RebuildsBetweenEventsOfABeadFromFarAway) {
  const ScratchDirectory directory;
  const std::string far = directory.file(
      "far.xyz", xyz({"1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}) +
                     xyz({"-1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}));
  const ProgramRun run = run_program(
      {"run", far, "--structures", "power", "--radius", "0.1", "--audit", "events", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["structures"]["power"]["audits"]["failed"], 0);
}

// Four beads start in one plane and move by units in the last place, which doubles cannot resolve.
TEST(Program, GoesOnWhereDoublesDoNotTellTheBeadsApart) {
  const ScratchDirectory directory;
  const std::string flat = directory.file("flat.txt",
                                          "5 3 1\n"
                                          "-1 -1 -2 -1.9999999999999998 -2 -2\n"
                                          "-1 -1 -2 -2 -2 -1.9999999999999998\n"
                                          "-1 -1 -2 -2 0 1.1102230246251565e-16\n"
                                          "-1 -1 0 1.1102230246251565e-16 0 -1.1102230246251565e-16\n"
                                          "-2 -2.0000000000000004 -1 -1 0 1.1102230246251565e-16\n");
  for (const char* kernel : {"filtered", "exact"}) {
    const ProgramRun run = run_program({"run", flat, "--kernel", kernel, "--json", "-"});
    EXPECT_EQ(run.code, 0) << kernel << ": " << run.err;
  }
}

// Every third bead is smaller, so the certificates of the hierarchy contain square roots.
TEST(Program, WrapsBallsOfSeveralSizes) {
  const ScratchDirectory directory;
  std::string radii;
  for (int b = 0; b < 108; ++b) radii += b % 3 == 0 ? "0.6\n" : "0.75\n";
  const std::string rule = "file:" + directory.file("radii.txt", radii);
  const std::vector<std::string> arguments{"run",          data_file("trajectories/villin_hp36_300K.dcd"),
                                           "--topology",   data_file("trajectories/villin_hp36_300K.pdb"),
                                           "--frames",     "0:4",
                                           "--structures", "wrapped",
                                           "--radius",     rule,
                                           "--audit",      "events",
                                           "--json",       "-"};
  for (const char* motion : {"linear", "hermite"}) {
    std::vector<std::string> one = arguments;
    one.insert(one.end(), {"--motion", motion});
    const ProgramRun run = run_program(one);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_GT(Json::parse(run.out)["structures"]["wrapped"]["events"]["total"], 0);
  }
}

TEST(Program, KeepsOnlyTheNodesAskedFor) {
  const ScratchDirectory directory;
  const std::string log = (directory.path() / "log").string();
  std::vector<std::string> arguments{
      "run", data_file("kinetic/d3_n50_linear.txt"), "--structures", "wrapped", "--json", "-", "--quiet"};
  const ProgramRun all = run_program(arguments);
  arguments.insert(arguments.end(), {"--levels", "0:2", "--log", log, "--dump", directory / "dump"});
  const ProgramRun some = run_program(arguments);
  ASSERT_EQ(some.code, 0) << some.err;
  const auto created = [](const ProgramRun& run) {
    return Json::parse(run.out)["structures"]["wrapped"]["certificates"]["created"].get<int>();
  };
  EXPECT_LT(created(some), created(all));
  EXPECT_EQ(Json::parse(some.out)["settings"]["levels"], "0:2");
  const std::string dump = content_of(directory / "dump/frame-1.wrapped.csv");
  EXPECT_EQ(std::count(dump.begin(), dump.end(), '\n'), 4);  // a header and three nodes
  EXPECT_EQ(run_program({"replay", log, "--quiet"}).code, 0);
}

TEST(Program, RunsSeveralNecklacesOnOneClock) {
  const std::string moving = data_file("trajectories/villin_hp36_300K.dcd");
  const std::string resting = data_file("trajectories/villin_hp36_300K.pdb");
  const ScratchDirectory directory;
  const std::string beads = xyz({"30 0 0", "31 0 0", "31 1 0", "32 1 1"});
  const std::string other =
      directory.file("other.xyz", beads + xyz({"30 0 0", "31 1 0", "31 1 1", "32 0 1"}));
  const std::string three = directory.file("three.xyz", beads + beads + beads);

  for (const std::vector<std::string>& inputs :
       {std::vector<std::string>{moving, other}, {moving, "--obstacle", resting}, {resting, other}}) {
    std::vector<std::string> arguments{"run", "--frames", "0:2", "--audit", "frames", "--json", "-"};
    arguments.insert(arguments.begin() + 1, inputs.begin(), inputs.end());
    const ProgramRun run = run_program(arguments);
    ASSERT_EQ(run.code, 0) << run.err;
    const Json summary = Json::parse(run.out);
    EXPECT_EQ(summary["input"]["files"].size(), 2U);
    EXPECT_EQ(summary["input"]["beads"], inputs.back() == resting ? 216 : 112);
    EXPECT_EQ(summary["input"]["frames"], 2);
    EXPECT_EQ(summary["structures"].size(), 2U);
  }
}

TEST(Program, TellsTheTimesThatAFileHas) {
  const ScratchDirectory directory;
  std::string bytes = content_of(kTrajectory);
  const float length = 2 / 48.88821F;  // steps of 2 fs, ten steps per frame
  const std::int32_t steps = 10;
  std::memcpy(&bytes[8 + 4 * 2], &steps, sizeof steps);
  std::memcpy(&bytes[8 + 4 * 9], &length, sizeof length);
  const ProgramRun run =
      run_program({"run", directory.file("timed.dcd", bytes), "--frames", "100:103", "--structures",
                   "wrapped", "--out", (directory / "out").string(), "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["input"]["picoseconds"], Json::array({2.0, 2.04}));
  const std::string csv = content_of(directory / "out/events.csv");
  EXPECT_TRUE(csv.starts_with("frame,structure,events,cumulative,picoseconds\n100,wrapped,")) << csv;
  EXPECT_THAT(csv, HasSubstr(",2.02\n"));
  EXPECT_THAT(content_of(directory / "out/report.html"), HasSubstr("from 2 to 2.04 ps"));
}

TEST(Program, RoundsChangeNothingButTimes) {
  const auto summary = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"run",     kTrajectory, "--frames", ":9",
                                       "--audit", "frames",    "--json",   "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out);
  };
  const Json once = summary({}), thrice = summary({"--rounds", "3"});
  EXPECT_EQ(once["fingerprint"], thrice["fingerprint"]);
  EXPECT_THAT(once["settings"]["rounds"], "");
  EXPECT_THAT(thrice["settings"]["rounds"], "3");
  EXPECT_THAT(thrice["command"].get<std::string>(), HasSubstr(" --rounds 3"));
  for (const auto& [name, structure] : thrice["structures"].items()) {
    const Json& single = once["structures"][name];
    for (const char* same : {"events", "certificates", "stages", "audits"})
      EXPECT_EQ(structure[same], single[same]) << name;
    EXPECT_FALSE(single.contains("seconds_least"));
    for (const std::string what : {"seconds", "static_seconds"}) {
      EXPECT_GT(structure[what + "_least"], 0) << name;
      EXPECT_LE(structure[what + "_least"], structure[what]) << name;
      EXPECT_LE(structure[what], structure[what + "_most"]) << name;
    }
  }
}

}  // namespace
}  // namespace kds::test::program_scenes_test
