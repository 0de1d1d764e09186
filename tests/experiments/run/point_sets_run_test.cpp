// Tests `kds run --structures box,hull,closest` as a process: events, dumps, logs and replays.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::point_sets_run_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Returns frames in which a bead leaves a square on its right, passes the height of a corner, and comes back.
std::string square_and_one() {
  std::string frames;
  for (const char* x : {"3", "5", "1"})
    frames += "5\nframe\nC 0 0 0\nC 4 0 0\nC 4 4 0\nC 0 4 0\nC " + std::string(x) + " 2 0\n";
  return frames;
}

TEST(PointSetsRun, ABeadThatComesOutOfASquareAndGoesBack) {
  const ScratchDirectory scratch;
  scratch.file("square.xyz", square_and_one());
  const Json structures = run_json(
      "run OUT/square.xyz --structures hull,closest,box --radius 1 --audit events --log OUT/log --dump "
      "OUT/dump "
      "--events OUT/events.csv",
      scratch.path())["structures"];
  EXPECT_EQ(structures["hull"]["events"]["enter"], 1);
  EXPECT_EQ(structures["hull"]["events"]["leave"], 1);
  EXPECT_EQ(structures["box"]["events"]["max-x"], 2);
  EXPECT_EQ(structures["box"]["events"]["total"], 2);
  EXPECT_EQ(structures["closest"]["events"]["replace"], 1);
  for (const char* name : {"box", "hull", "closest"}) {
    EXPECT_EQ(structures[name]["audits"]["failed"], 0);
    EXPECT_GT(structures[name]["audits"]["run"], 0);
  }
  EXPECT_EQ(content_of(scratch / "dump/frame-1.hull.csv"), "bead\n0\n1\n4\n2\n3\n");
  EXPECT_EQ(content_of(scratch / "dump/frame-2.hull.csv"), "bead\n0\n1\n2\n3\n");
  EXPECT_EQ(content_of(scratch / "dump/frame-1.box.csv"), "axis,min,max\nx,0,4\ny,0,2\n");
  EXPECT_EQ(content_of(scratch / "dump/frame-0.closest.csv"), "i,j\n1,4\n");
  EXPECT_EQ(content_of(scratch / "dump/frame-2.closest.csv"), "i,j\n0,4\n");
  EXPECT_THAT(content_of(scratch / "log"), HasSubstr("0 hull enter 0.5 0.5 4 1 2\n"));
  EXPECT_THAT(content_of(scratch / "events.csv"), HasSubstr(",hull,enter,1,"));
  run_line("replay OUT/log --quiet", scratch.path());
}

TEST(PointSetsRun, AreComparedFromFrameToFrame) {
  const ScratchDirectory scratch;
  scratch.file("square.xyz", square_and_one());
  const Json rows =
      run_json("compare OUT/square.xyz --radius 1 --structures box,hull,closest", scratch.path())["rows"];
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& [row, structure, changes] : {std::tuple(0, "box", 2), {1, "hull", 2}, {2, "closest", 1}}) {
    EXPECT_EQ(rows[row]["structure"], structure);
    EXPECT_EQ(rows[row]["net_changes"], changes);
  }
}

}  // namespace
}  // namespace kds::test::point_sets_run_test
