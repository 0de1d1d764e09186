// Tests the program as a process: the scenes that it runs, and their counts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_scenes_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

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
  directory.file("linear.txt", linear);
  directory.file("quartic.txt", quartic);
  for (const std::string structure : {"sorted", "power", "wrapped"}) {
    const auto result = [&](const std::string& file) {
      return run_json("run OUT/" + file + " --quiet --audit events --structures " + structure,
                      directory.path());
    };
    const Json expected = result("linear.txt"), found = result("quartic.txt");
    EXPECT_GT(expected["structures"][structure]["events"]["total"], 0);
    EXPECT_EQ(found["structures"][structure]["events"], expected["structures"][structure]["events"]);
    EXPECT_EQ(found["fingerprint"], expected["fingerprint"]);
  }
}

TEST(Program, BeadsThatKeepToAPlaneOfTwoAxesRunInTwoDimensions) {
  const ScratchDirectory directory;
  directory.file("flat.xyz", xyz({"0 7 0", "1 7 0", "2 7 1", "3 7 0", "4 7 1"}) +
                                 xyz({"0 7 1", "1 7 0", "2 7 2", "3 7 3", "4 7 2"}));
  const std::string radii = "file:" + directory.file("radii.txt", "0.5\n0.6\n0.5\n0.7\n0.6\n");
  for (const std::string motion : {"linear", "hermite", "lifted"}) {
    for (const std::string& rule : {std::string("auto"), radii}) {
      SCOPED_TRACE(motion + " " + rule);
      const Json result = run_json(
          "run OUT/flat.xyz --audit events --dump OUT/dump --replace --quiet --motion " + motion +
              " --radius " + rule + " --structures " + (motion == "lifted" ? "power" : "wrapped,power"),
          directory.path());
      EXPECT_EQ(result["input"]["dimension"], 2);
      EXPECT_GT(result["structures"]["power"]["events"]["total"], 0);
      EXPECT_EQ(content_of(directory / "dump/frame-1.power.csv").substr(0, 6), "a,b,c\n");
      if (motion != "lifted") {
        EXPECT_THAT(content_of(directory / "dump/frame-1.wrapped.csv"), HasSubstr(",7,"));
      }
    }
  }
}

// A bead comes from so far away that all its events lie within 2^-200 of the step.
TEST(Program, RebuildsBetweenEventsOfABeadFromFarAway) {
  const ScratchDirectory directory;
  directory.file("far.xyz",
                 xyz({"1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}) +
                     xyz({"-1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}));
  const Json run =
      run_json("run OUT/far.xyz --structures power --radius 0.1 --audit events", directory.path());
  EXPECT_EQ(run["structures"]["power"]["audits"]["failed"], 0);
}

// Four beads start in one plane and move by units in the last place, which doubles cannot resolve.
TEST(Program, GoesOnWhereDoublesDoNotTellTheBeadsApart) {
  const ScratchDirectory directory;
  directory.file("flat.txt",
                 "5 3 1\n"
                 "-1 -1 -2 -1.9999999999999998 -2 -2\n"
                 "-1 -1 -2 -2 -2 -1.9999999999999998\n"
                 "-1 -1 -2 -2 0 1.1102230246251565e-16\n"
                 "-1 -1 0 1.1102230246251565e-16 0 -1.1102230246251565e-16\n"
                 "-2 -2.0000000000000004 -1 -1 0 1.1102230246251565e-16\n");
  for (const std::string kernel : {"filtered", "exact"})
    run_line("run OUT/flat.txt --kernel " + kernel, directory.path());
}

// Every third bead is smaller, so the certificates of the hierarchy contain square roots.
TEST(Program, WrapsBallsOfSeveralSizes) {
  const ScratchDirectory directory;
  std::string radii;
  for (int b = 0; b < 108; ++b) radii += b % 3 == 0 ? "0.6\n" : "0.75\n";
  directory.file("radii.txt", radii);
  for (const std::string motion : {"linear", "hermite"}) {
    const Json run = run_json("run VILLIN --frames 0:4 --structures wrapped --audit events --radius file:" +
                              (directory / "radii.txt").string() + " --motion " + motion);
    EXPECT_GT(run["structures"]["wrapped"]["events"]["total"], 0);
  }
}

TEST(Program, KeepsOnlyTheNodesAskedFor) {
  const ScratchDirectory directory;
  const std::string line = "run data/kinetic/d3_n50_linear.txt --structures wrapped --quiet";
  const Json all = run_json(line),
             some = run_json(line + " --levels 0:2 --log OUT/log --dump OUT/dump", directory.path());
  const auto created = [](const Json& run) {
    return run["structures"]["wrapped"]["certificates"]["created"].get<int>();
  };
  EXPECT_LT(created(some), created(all));
  EXPECT_EQ(some["settings"]["levels"], "0:2");
  const std::string dump = content_of(directory / "dump/frame-1.wrapped.csv");
  EXPECT_EQ(std::count(dump.begin(), dump.end(), '\n'), 4);  // a header and three nodes
  run_line("replay OUT/log --quiet", directory.path());
}

TEST(Program, RunsSeveralNecklacesOnOneClock) {
  const ScratchDirectory directory;
  const std::string moving = "data/trajectories/villin_hp36_300K.dcd",
                    resting = "data/trajectories/villin_hp36_300K.pdb";
  directory.file("other.xyz", xyz({"30 0 0", "31 0 0", "31 1 0", "32 1 1"}) +
                                  xyz({"30 0 0", "31 1 0", "31 1 1", "32 0 1"}));
  for (const std::string& inputs : {moving + " OUT/other.xyz", moving + " --format dcd --obstacle " + resting,
                                    resting + " OUT/other.xyz"}) {
    const Json summary = run_json("run --frames 0:2 --audit frames " + inputs, directory.path());
    EXPECT_EQ(summary["input"]["files"].size(), 2U);
    EXPECT_EQ(summary["input"]["beads"], inputs.ends_with(resting) ? 216 : 112);
    EXPECT_EQ(summary["input"]["frames"], 2);
    EXPECT_EQ(summary["structures"].size(), 2U);
  }
}

TEST(Program, TellsTheTimesThatAFileHas) {
  const ScratchDirectory directory;
  std::string bytes = content_of(data_file("trajectories/villin_hp36_300K.dcd"));
  const float length = 2 / 48.88821F;  // steps of 2 fs, ten steps per frame
  const std::int32_t steps = 10;
  std::memcpy(&bytes[8 + 4 * 2], &steps, sizeof steps);
  std::memcpy(&bytes[8 + 4 * 9], &length, sizeof length);
  directory.file("timed.dcd", bytes);
  const Json run =
      run_json("run OUT/timed.dcd --frames 100:103 --structures wrapped --out OUT/out", directory.path());
  EXPECT_EQ(run["input"]["picoseconds"], Json::array({2.0, 2.04}));
  const std::string csv = content_of(directory / "out/events.csv");
  EXPECT_TRUE(csv.starts_with("frame,structure,events,cumulative,picoseconds\n100,wrapped,")) << csv;
  EXPECT_THAT(csv, HasSubstr(",2.02\n"));
}

TEST(Program, RoundsChangeNothingButTimes) {
  const std::string line = "run data/trajectories/villin_hp36_300K.dcd --frames :9 --audit frames";
  const Json once = run_json(line), thrice = run_json(line + " --rounds 3");
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
