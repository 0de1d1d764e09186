// Tests `kds run --structures boxes` as a process: events, dumps, logs and replays.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::boxes_run_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Returns frames in which the third bead passes the second along x, and comes back.
std::string three_beads() {
  std::string frames;
  for (const char* x : {"3", "5", "1"})
    frames += "3\nframe\nC 0 0 0\nC 4 0 0\nC " + std::string(x) + " 2 0\n";
  return frames;
}

TEST(BoxesRun, ABeadThatComesOutOfABoxAndGoesBack) {
  const ScratchDirectory scratch;
  const std::string input = scratch.file("three.xyz", three_beads());
  const ProgramRun run =
      run_program({"run", input, "--structures", "boxes", "--radius", "1", "--audit", "events", "--json", "-",
                   "--log", scratch / "log", "--dump", scratch / "dump", "--events", scratch / "events.csv"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json boxes = Json::parse(run.out)["structures"]["boxes"];
  EXPECT_EQ(boxes["events"]["support"], 2);
  EXPECT_EQ(boxes["events"]["total"], 2);
  EXPECT_EQ(boxes["audits"]["failed"], 0);
  EXPECT_GT(boxes["audits"]["run"], 2);
  EXPECT_EQ(content_of(scratch / "dump/frame-0.boxes.csv"),
            "first,last,supports,ends\n0,2,0 1 0 2 0 0,-1 5 -1 3 -1 1\n0,1,0 1 0 0 0 0,-1 5 -1 1 -1 1\n");
  EXPECT_EQ(content_of(scratch / "dump/frame-1.boxes.csv"),
            "first,last,supports,ends\n0,2,0 2 0 2 0 0,-1 6 -1 3 -1 1\n0,1,0 1 0 0 0 0,-1 5 -1 1 -1 1\n");
  EXPECT_THAT(content_of(scratch / "log"), HasSubstr("0 boxes support 0.5 0.5 "));
  EXPECT_THAT(content_of(scratch / "log"), HasSubstr(" 0 2 1 1 2\n"));
  EXPECT_THAT(content_of(scratch / "events.csv"), HasSubstr(",boxes,support,1,"));
  EXPECT_EQ(run_program({"replay", scratch / "log", "--quiet"}).code, 0);
}

TEST(BoxesRun, KernelsAndReplaysGoTheSameWay) {
  const ScratchDirectory scratch;
  const std::vector<std::vector<std::string>> inputs{
      {data_file("kinetic/d2_n50_degree3.txt"), "--directions", "4"},
      {data_file("kinetic/degenerate_d3_n64_gridrand.txt"), "--directions", "13"},
      {data_file("kinetic/degenerate_d3_n64_swap.txt"), "--directions", "7", "--levels", "0:2"},
      {data_file("proteins/1l2y.pdb"), "--select", "all", "--radius", "element", "--frames", "0:2",
       "--directions", "13"},
      {data_file("trajectories/villin_hp36_300K.dcd"), "--frames", "0:4", "--motion", "hermite"}};
  for (const auto& input : inputs) {
    SCOPED_TRACE(input.front());
    std::vector<std::string> arguments{"run", "--structures", "boxes",         "--json",
                                       "-",   "--log",        scratch / "log", "--quiet"};
    arguments.insert(arguments.begin() + 1, input.begin(), input.end());
    const ProgramRun filtered = run_program(arguments);
    ASSERT_EQ(filtered.code, 0) << filtered.err;
    EXPECT_GT(Json::parse(filtered.out)["structures"]["boxes"]["events"]["total"], 0);
    EXPECT_EQ(run_program({"replay", scratch / "log", "--quiet"}).code, 0);
    arguments.insert(arguments.end(), {"--kernel", "exact"});
    const ProgramRun exact = run_program(arguments);
    ASSERT_EQ(exact.code, 0) << exact.err;
    EXPECT_EQ(Json::parse(exact.out)["fingerprint"], Json::parse(filtered.out)["fingerprint"]);
  }
}

}  // namespace
}  // namespace kds::test::boxes_run_test
