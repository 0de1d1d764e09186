// Pairs in question are those that PairsAsked::asks accepts.

#include "structures/necklace/pairs_in_question.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

namespace kds::pairs_in_question_test {
namespace {

TEST(PairsInQuestion, AreThoseAskedFor) {
  std::mt19937 random(3);
  const auto below = [&](unsigned n) { return static_cast<BeadId>(random() % n); };
  std::size_t with_groups = 0;
  for (int round = 0; round < 300; ++round) {
    PairsAsked asked;
    BeadId beads = 0;
    for (BeadId necklaces = 1 + below(4); necklaces > 0; --necklaces) {
      const BeadId count = 1 + below(9);
      asked.necklaces.push_back({beads, beads + count - 1});
      beads += count;
    }
    asked.apart = 1 + below(5);
    asked.within = below(4) != 0;
    asked.between = below(4) != 0;
    if (below(2) != 0)
      for (std::size_t n = 0; n < asked.necklaces.size(); ++n) asked.at_rest.push_back(below(2) != 0);
    if (below(3) != 0)
      for (BeadId b = 0; b < beads; ++b) asked.groups.push_back(static_cast<std::uint8_t>(below(4)));
    std::vector<BeadPair> expected, found;
    for (BeadId i = 0; i < beads; ++i)
      for (BeadId j = i + 1; j < beads; ++j)
        if (asked.asks({i, j})) expected.push_back({i, j});
    const PairsInQuestion pairs(asked);
    pairs.for_each([&](BeadId i, BeadId j) { found.push_back({i, j}); });
    ASSERT_EQ(found, expected) << round;
    ASSERT_EQ(pairs.count(), expected.size()) << round;
    if (!asked.groups.empty()) with_groups += expected.size();
  }
  EXPECT_GT(with_groups, 1000U);
}

// One necklace moves between two obstacles.
TEST(PairsInQuestion, LeaveOutPairsOfBeadsAtRest) {
  const PairsAsked asked{{{0, 2}, {3, 5}, {6, 7}}, true, 2, true, {}, {true, false, true}};
  std::vector<BeadPair> found;
  PairsInQuestion(asked).for_each([&](BeadId i, BeadId j) { found.push_back({i, j}); });
  EXPECT_EQ(found, (std::vector<BeadPair>{{0, 3},
                                          {0, 4},
                                          {0, 5},
                                          {1, 3},
                                          {1, 4},
                                          {1, 5},
                                          {2, 3},
                                          {2, 4},
                                          {2, 5},
                                          {3, 5},
                                          {3, 6},
                                          {3, 7},
                                          {4, 6},
                                          {4, 7},
                                          {5, 6},
                                          {5, 7}}));
  EXPECT_FALSE(asked.asks({0, 2}));  // of one obstacle
  EXPECT_FALSE(asked.asks({2, 6}));  // of two
  EXPECT_TRUE(asked.asks({3, 5}));
  EXPECT_TRUE(asked.asks({2, 3}));
}

TEST(PairsInQuestion, RefuseGroupsOfOtherBeadsAndRestOfOtherNecklaces) {
  const PairsAsked groups{{{0, 2}}, true, 2, true, {1, 2}};
  EXPECT_THROW(PairsInQuestion{groups}, std::invalid_argument);
  const PairsAsked rest{{{0, 2}}, true, 2, true, {}, {false, true}};
  EXPECT_THROW(PairsInQuestion{rest}, std::invalid_argument);
}

}  // namespace
}  // namespace kds::pairs_in_question_test
