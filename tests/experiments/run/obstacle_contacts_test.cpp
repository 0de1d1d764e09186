// Two beads at rest are no contact, of one obstacle or of two: every command counts the contacts of beads
// that move, with right values found by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::obstacle_contacts_test {
namespace {

using Json = nlohmann::ordered_json;

// A bead passes a wall of four beads from x = -9 to 9, comes back to x = 0 and leaves. On each of
// its two ways it comes within 1.5 of three beads of the wall. Two pairs of beads of the wall, 0 and 3, and
// 1 and 3, are within 1.5 of each other and not neighbours.
struct Wall {
  ScratchDirectory directory;
  Wall() {
    directory.file("passes.xyz", "1\n\nC -9 0 0\n1\n\nC 9 0 0\n1\n\nC 0 0 0\n1\n\nC -9 0 0\n");
    directory.file("wall.xyz", "4\n\nC 0 0 0\nC 0 1 0\nC 0 2 0\nC 0 0 1\n");
    directory.file("post.xyz", "1\n\nC 0 0.5 0.5\n");  // near beads 0, 1 and 3 of the wall
    directory.file("here.xyz", "1\n\nC 0 0 0\n");
    // Two beads that meet from the start, and go on 9 along x.
    directory.file("pair.xyz", "3\n\nC -9 9 0\nC -9 9 5\nC -9 9 1\n3\n\nC 0 9 0\nC 0 9 5\nC 0 9 1\n");
  }
  Json run(const std::string& line) const { return run_json(line + " --quiet", directory.path()); }
};

TEST(ObstacleContacts, OfRun) {
  const Wall w;
  struct Case {
    std::string inputs;
    int begins, at_start, at_end;
  };
  for (const Case& one : {
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz", 6, 0, 0},
           Case{"OUT/passes.xyz OUT/wall.xyz", 6, 0, 0},
           Case{"OUT/wall.xyz OUT/passes.xyz", 6, 0, 0},
           Case{"OUT/passes.xyz OUT/post.xyz --obstacle OUT/wall.xyz", 8, 0, 0},
           Case{"OUT/passes.xyz OUT/post.xyz OUT/wall.xyz", 8, 0, 0},
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz --apart 1", 6, 0, 0},
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz --kernel exact", 6, 0, 0},
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz --threads 2", 6, 0, 0},
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz --motion hermite", 6, 0, 0},
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz --frames 2:", 0, 3, 0},
           Case{"OUT/pair.xyz --obstacle OUT/wall.xyz", 0, 1, 1},
       }) {
    SCOPED_TRACE(one.inputs);
    const Json contacts = w.run("run --structures contacts --cutoff 1.5 --radius 1 --audit events " +
                                one.inputs)["structures"]["contacts"];
    EXPECT_EQ(contacts["events"]["begin"], one.begins);
    EXPECT_EQ(contacts["contacts"]["at_start"], one.at_start);
    EXPECT_EQ(contacts["contacts"]["at_end"], one.at_end);
    EXPECT_EQ(contacts["audits"]["failed"], 0);
  }
}

TEST(ObstacleContacts, OfMissed) {
  const Wall w;
  for (const std::string more : {"--cutoff 1.5", "--factors 0.75"}) {
    const Json row = w.run("missed OUT/passes.xyz --obstacle OUT/wall.xyz --radius 1 " + more)["rows"][0];
    EXPECT_EQ(row["contacts"], 6) << row;
    EXPECT_EQ(row["found"], 3) << row;  // the bead rests at x = 0 in one frame
  }
}

TEST(ObstacleContacts, OfContacts) {
  const Wall w;
  for (const std::string more : {"--obstacle OUT/wall.xyz", "OUT/wall.xyz", "OUT/post.xyz OUT/wall.xyz"}) {
    const Json all = w.run("contacts OUT/passes.xyz --cutoff 1.5 --strides 1 " + more)["all"];
    const bool has_post = more.starts_with("OUT/post");
    EXPECT_EQ(all["pairs"], has_post ? 4 : 3) << all;
    EXPECT_EQ(all["contacts"], has_post ? 8 : 6) << all;
    EXPECT_EQ(all["open_at_both"], 0) << all;  // nothing is in contact throughout
  }
}

TEST(ObstacleContacts, OfCollide) {
  const Wall w;
  struct Case {
    std::string inputs;
    int pairs;  // over all frames
  };
  for (const Case& one : {
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz", 3},
           Case{"OUT/passes.xyz OUT/wall.xyz", 3},
           Case{"OUT/passes.xyz OUT/post.xyz --obstacle OUT/wall.xyz", 4},
           Case{"OUT/here.xyz --obstacle OUT/wall.xyz", 3},
           Case{"OUT/here.xyz OUT/wall.xyz", 5},  // nothing moves, and no file is an obstacle
           Case{"OUT/passes.xyz --obstacle OUT/wall.xyz --pairs between", 3},
           Case{"OUT/passes.xyz OUT/wall.xyz --within 0.5", 4},
       }) {
    SCOPED_TRACE(one.inputs);
    const Json rows = w.run("collide --radius 0.75 " + one.inputs)["rows"];
    EXPECT_GE(rows.size(), 5U);
    for (const Json& row : rows) {
      EXPECT_EQ(row["pairs"], one.pairs) << row;
      if (!row["closest"].is_null()) {
        EXPECT_EQ(row["closest"]["distance"], -1.5) << row;
      }
    }
  }
}

// The exact run and the truth that it is compared with ask about the same pairs.
TEST(ObstacleContacts, OfTrade) {
  const Wall w;
  const Json json = w.run(
      "trade OUT/passes.xyz OUT/wall.xyz --radius 0.75 --want contacts --rounds 1 --without-exact --times 5");
  ASSERT_FALSE(json["rows"].empty());
  const Json& exact = json["rows"][0];
  EXPECT_EQ(exact["cost"]["events"], 12) << exact;
  EXPECT_EQ(exact["error"]["contacts_missed"], 0) << exact;
  EXPECT_EQ(exact["error"]["contacts_spurious"], 0) << exact;
}

}  // namespace
}  // namespace kds::test::obstacle_contacts_test
