// kds run with chord cages, from outside: its files, its options, and what it refuses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::chord_run_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

std::vector<std::string> villin(std::vector<std::string> more) {
  std::vector<std::string> arguments{"run",        data_file("trajectories/villin_hp36_300K.dcd"),
                                     "--topology", data_file("trajectories/villin_hp36_300K.pdb"),
                                     "--frames",   "0:6",
                                     "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(ChordRun, TheDumpAtFramesIsThatOfTheRunWithEvents) {
  const ScratchDirectory scratch;
  for (const char* motion : {"linear", "hermite"}) {
    for (const char* between : {"events", "chord"}) {
      const ProgramRun run = run_program(villin({"--structures", "wrapped", "--between", between, "--motion",
                                                 motion, "--audit", "frames", "--dump", scratch / between}));
      ASSERT_EQ(run.code, 0) << run.err;
    }
    for (const char* frame : {"frame-0", "frame-3", "frame-5"}) {
      const std::string file = std::string("/") + frame + ".wrapped.csv";
      EXPECT_EQ(content_of(scratch / ("chord" + file)), content_of(scratch / ("events" + file)));
    }
  }
}

TEST(ChordRun, CountsBisectionsAndNoEvents) {
  const ProgramRun run = run_program(villin(
      {"--structures", "wrapped,layered", "--between", "chord", "--tightness", "0.0005", "--json", "-"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(run.out);
  EXPECT_EQ(summary["settings"]["between"], "chord");
  EXPECT_EQ(summary["settings"]["tightness"], "0.0005");
  const Json& wrapped = summary["structures"]["wrapped"];
  EXPECT_EQ(wrapped["events"]["total"], 0);
  EXPECT_GT(wrapped["events"]["bisection"], 0);
  EXPECT_EQ(wrapped["events"]["unproved"], 0);
  EXPECT_EQ(wrapped["certificates"]["created"], 0);
  EXPECT_EQ(summary["structures"]["layered"]["events"]["total"], 0);
}

TEST(ChordRun, WritesLayeredSpheres) {
  const ScratchDirectory scratch;
  const ProgramRun run = run_program(villin(
      {"--structures", "layered", "--audit", "frames", "--levels", "0:2", "--dump", scratch / "dump"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string text = content_of(scratch / "dump/frame-5.layered.csv");
  EXPECT_THAT(text, StartsWith("first,last,x,y,z,radius\n0,107,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);  // a header and three nodes
}

TEST(ChordRun, RefusesWhatHasNoEventsAndWhatDoesNotGoTogether) {
  const ScratchDirectory scratch;
  const auto refusal = [&](std::vector<std::string> more) {
    const ProgramRun run = run_program(villin(std::move(more)));
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  const std::string log = scratch / "log";
  EXPECT_THAT(refusal({"--between", "chord", "--log", log}), HasSubstr("--log: wrapped is of chord cages"));
  EXPECT_THAT(refusal({"--structures", "layered,power", "--log", log}), HasSubstr("--log: layered"));
  EXPECT_THAT(refusal({"--between", "chord", "--audit", "events"}), HasSubstr("--audit events"));
  EXPECT_THAT(refusal({"--structures", "power", "--between", "chord"}), HasSubstr("--between"));
  EXPECT_THAT(refusal({"--tightness", "0.1"}), HasSubstr("--between chord"));
  EXPECT_THAT(refusal({"--between", "chord", "--tightness", "0"}), HasSubstr("--tightness"));
  EXPECT_THAT(refusal({"--between", "chords"}), HasSubstr("events, chord"));
  EXPECT_THAT(refusal({"--structures", "layered", "--motion", "lifted"}), HasSubstr("radii"));
}

}  // namespace
}  // namespace kds::test::chord_run_test
