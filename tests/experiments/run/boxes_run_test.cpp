// Tests `kds run --structures boxes` as a process: events, dumps, logs and replays.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/run_json.h"
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
  scratch.file("three.xyz", three_beads());
  const Json boxes = run_json(
      "run OUT/three.xyz --structures boxes --radius 1 --audit events --log OUT/log --dump OUT/dump "
      "--events OUT/events.csv",
      scratch.path())["structures"]["boxes"];
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
  run_line("replay OUT/log --quiet", scratch.path());
}

TEST(BoxesRun, KernelsAndReplaysGoTheSameWay) {
  const ScratchDirectory scratch;
  for (const std::string input : {
           "data/kinetic/d2_n50_degree3.txt --directions 4",
           "data/kinetic/degenerate_d3_n64_gridrand.txt --directions 13",
           "data/kinetic/degenerate_d3_n64_swap.txt --directions 7 --levels 0:2",
           "data/proteins/1l2y.pdb --select all --radius element --frames 0:2 --directions 13",
           "data/trajectories/villin_hp36_300K.dcd --frames 0:4 --motion hermite",
       }) {
    SCOPED_TRACE(input);
    const std::string line = "run " + input + " --structures boxes --quiet --log OUT/log";
    const Json filtered = run_json(line, scratch.path());
    EXPECT_GT(filtered["structures"]["boxes"]["events"]["total"], 0);
    run_line("replay OUT/log --quiet", scratch.path());
    EXPECT_EQ(run_json(line + " --kernel exact", scratch.path())["fingerprint"], filtered["fingerprint"]);
  }
}

}  // namespace
}  // namespace kds::test::boxes_run_test
