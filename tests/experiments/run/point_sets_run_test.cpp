// Tests `kds run --structures box,hull,closest` as a process: events, dumps, logs, replays and refusals.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/rounds.h"

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
  const std::string input = scratch.file("square.xyz", square_and_one());
  const ProgramRun run = run_program({"run", input, "--structures", "hull,closest,box", "--radius", "1",
                                      "--audit", "events", "--json", "-", "--log", scratch / "log", "--dump",
                                      scratch / "dump", "--events", scratch / "events.csv"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json structures = Json::parse(run.out)["structures"];
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
  EXPECT_EQ(run_program({"replay", scratch / "log", "--quiet"}).code, 0);
}

TEST(PointSetsRun, KernelsAndReplaysGoTheSameWay) {
  const ScratchDirectory scratch;
  std::vector<std::string> names{"degenerate_d2_n64_swap", "d2_n50_degree3", "degenerate_d2_n64_gridrand"};
  names.resize(rounds(3U));
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    std::vector<std::string> arguments{"run",          data_file("kinetic/" + name + ".txt"),
                                       "--structures", "box,hull,closest,power",
                                       "--json",       "-",
                                       "--log",        scratch / "log"};
    const ProgramRun filtered = run_program(arguments);
    ASSERT_EQ(filtered.code, 0) << filtered.err;
    EXPECT_EQ(run_program({"replay", scratch / "log", "--quiet"}).code, 0);
    arguments.insert(arguments.end(), {"--kernel", "exact"});
    const ProgramRun exact = run_program(arguments);
    ASSERT_EQ(exact.code, 0) << exact.err;
    EXPECT_EQ(Json::parse(exact.out)["fingerprint"], Json::parse(filtered.out)["fingerprint"]);
  }
}

TEST(PointSetsRun, HullsAreInThePlane) {
  const ProgramRun run = run_program({"run", data_file("kinetic/d3_n20_linear.txt"), "--structures", "hull"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("hull: needs points in the plane, this input has 3 coordinates"));
  const ProgramRun line =
      run_program({"run", data_file("kinetic/d1_n20_linear.txt"), "--structures", "closest"});
  EXPECT_EQ(line.code, 2);
  EXPECT_THAT(line.err, HasSubstr("closest: needs points in the plane or in space"));
  EXPECT_EQ(std::count(line.err.begin(), line.err.end(), '\n'), 1);
}

TEST(PointSetsRun, AreComparedFromFrameToFrame) {
  const ScratchDirectory scratch;
  const std::string input = scratch.file("square.xyz", square_and_one());
  const ProgramRun run =
      run_program({"compare", input, "--radius", "1", "--structures", "box,hull,closest", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json rows = Json::parse(run.out)["rows"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0]["structure"], "box");
  EXPECT_EQ(rows[0]["net_changes"], 2);
  EXPECT_EQ(rows[1]["structure"], "hull");
  EXPECT_EQ(rows[1]["net_changes"], 2);
  EXPECT_EQ(rows[2]["structure"], "closest");
  EXPECT_EQ(rows[2]["net_changes"], 1);
}

}  // namespace
}  // namespace kds::test::point_sets_run_test
