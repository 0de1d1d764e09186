// Two beads at rest are no contact, of one obstacle or of two: every command counts the contacts of beads
// that move, with right values found by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::obstacle_contacts_test {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

// A bead passes a wall of four beads from x = -9 to 9, comes back to x = 0 and leaves. On each of
// its two ways it comes within 1.5 of three beads of the wall. Two pairs of beads of the wall, 0 and 3, and
// 1 and 3, are within 1.5 of each other and not neighbours.
struct Wall {
  ScratchDirectory directory;
  std::string passes =
      directory.file("passes.xyz", "1\n\nC -9 0 0\n1\n\nC 9 0 0\n1\n\nC 0 0 0\n1\n\nC -9 0 0\n");
  std::string wall = directory.file("wall.xyz", "4\n\nC 0 0 0\nC 0 1 0\nC 0 2 0\nC 0 0 1\n");
  std::string post = directory.file("post.xyz", "1\n\nC 0 0.5 0.5\n");  // near beads 0, 1 and 3 of the wall
  // Two beads that meet from the start, and go on 9 along x.
  std::string pair = directory.file("pair.xyz",
                                    "3\n\nC -9 9 0\nC -9 9 5\nC -9 9 1\n"
                                    "3\n\nC 0 9 0\nC 0 9 5\nC 0 9 1\n");

  Json run(Words words) const {
    words.insert(words.end(), {"--json", "-", "--quiet"});
    const ProgramRun done = run_program(words);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? Json::parse(done.out) : Json();
  }
};

TEST(ObstacleContacts, OfRun) {
  const Wall w;
  struct Case {
    Words words;
    int begins, at_start, at_end;
  };
  const std::vector<Case> cases{
      {{w.passes, "--obstacle", w.wall}, 6, 0, 0},
      {{w.passes, w.wall}, 6, 0, 0},
      {{w.wall, w.passes}, 6, 0, 0},
      {{w.passes, w.post, "--obstacle", w.wall}, 8, 0, 0},
      {{w.passes, w.post, w.wall}, 8, 0, 0},
      {{w.passes, "--obstacle", w.wall, "--apart", "1"}, 6, 0, 0},
      {{w.passes, "--obstacle", w.wall, "--kernel", "exact"}, 6, 0, 0},
      {{w.passes, "--obstacle", w.wall, "--threads", "2"}, 6, 0, 0},
      {{w.passes, "--obstacle", w.wall, "--motion", "hermite"}, 6, 0, 0},
      {{w.passes, "--obstacle", w.wall, "--frames", "2:"}, 0, 3, 0},
      {{w.pair, "--obstacle", w.wall}, 0, 1, 1},
  };
  for (const Case& one : cases) {
    Words words{"run", "--structures", "contacts", "--cutoff", "1.5", "--radius", "1", "--audit", "events"};
    words.insert(words.end(), one.words.begin(), one.words.end());
    const Json contacts = w.run(words)["structures"]["contacts"];
    EXPECT_EQ(contacts["events"]["begin"], one.begins) << testing::PrintToString(one.words);
    EXPECT_EQ(contacts["contacts"]["at_start"], one.at_start) << testing::PrintToString(one.words);
    EXPECT_EQ(contacts["contacts"]["at_end"], one.at_end) << testing::PrintToString(one.words);
    EXPECT_EQ(contacts["audits"]["failed"], 0) << testing::PrintToString(one.words);
  }
}

TEST(ObstacleContacts, OfMissed) {
  const Wall w;
  for (const Words& more : {Words{"--cutoff", "1.5"}, Words{"--factors", "0.75"}}) {
    Words words{"missed", w.passes, "--obstacle", w.wall, "--radius", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Json row = w.run(words)["rows"][0];
    EXPECT_EQ(row["contacts"], 6) << row;
    EXPECT_EQ(row["found"], 3) << row;  // the bead rests at x = 0 in one frame
  }
}

TEST(ObstacleContacts, OfContacts) {
  const Wall w;
  for (const Words& more : {Words{"--obstacle", w.wall}, Words{w.wall}, Words{w.post, w.wall}}) {
    Words words{"contacts", w.passes, "--cutoff", "1.5", "--strides", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const Json all = w.run(words)["all"];
    const bool has_post = more.size() == 2 && more[0] == w.post;
    EXPECT_EQ(all["pairs"], has_post ? 4 : 3) << all;
    EXPECT_EQ(all["contacts"], has_post ? 8 : 6) << all;
    EXPECT_EQ(all["open_at_both"], 0) << all;  // nothing is in contact throughout
  }
}

TEST(ObstacleContacts, OfCollide) {
  const Wall w;
  struct Case {
    Words words;
    int pairs;  // over all frames
    double closest;
  };
  const std::string here = w.directory.file("here.xyz", "1\n\nC 0 0 0\n");
  const std::vector<Case> cases{
      {{w.passes, "--obstacle", w.wall}, 3, -1.5},
      {{w.passes, w.wall}, 3, -1.5},
      {{w.passes, w.post, "--obstacle", w.wall}, 4, -1.5},
      {{here, "--obstacle", w.wall}, 3, -1.5},
      {{here, w.wall}, 5, -1.5},  // nothing moves, and no file is an obstacle
      {{w.passes, "--obstacle", w.wall, "--pairs", "between"}, 3, -1.5},
      {{w.passes, w.wall, "--within", "0.5"}, 4, -1.5},
  };
  for (const Case& one : cases) {
    Words words{"collide", "--radius", "0.75"};
    words.insert(words.end(), one.words.begin(), one.words.end());
    const Json rows = w.run(words)["rows"];
    EXPECT_GE(rows.size(), 5U) << testing::PrintToString(one.words);
    for (const Json& row : rows) {
      EXPECT_EQ(row["pairs"], one.pairs) << row << testing::PrintToString(one.words);
      if (!row["closest"].is_null()) {
        EXPECT_EQ(row["closest"]["distance"], one.closest) << row;
      }
    }
  }
}

// The exact run and the truth that it is compared with ask about the same pairs.
TEST(ObstacleContacts, OfTrade) {
  const Wall w;
  const Json json = w.run({"trade", w.passes, w.wall, "--radius", "0.75", "--want", "contacts", "--rounds",
                           "1", "--without-exact", "--times", "5"});
  ASSERT_FALSE(json["rows"].empty());
  const Json& exact = json["rows"][0];
  EXPECT_EQ(exact["cost"]["events"], 12) << exact;
  EXPECT_EQ(exact["error"]["contacts_missed"], 0) << exact;
  EXPECT_EQ(exact["error"]["contacts_spurious"], 0) << exact;
}

}  // namespace
}  // namespace kds::test::obstacle_contacts_test
