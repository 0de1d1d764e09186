#include "motions/frames/chain_breaks.h"

#include <gtest/gtest.h>

namespace kds::chain_breaks_test {
namespace {

Eigen::Matrix3Xd on_a_line(const std::vector<double>& places) {
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) frame(0, static_cast<Eigen::Index>(i)) = places[i];
  return frame;
}

using Breaks = std::vector<std::size_t>;

TEST(ChainBreaks, LongerThanOneAndAHalfMedians) {
  EXPECT_EQ(find_chain_breaks(on_a_line({0, 1, 2, 3.5, 4.5})), Breaks{});  // 1.5 is not longer than the limit
  EXPECT_EQ(find_chain_breaks(on_a_line({0, 1, 2, 3.75, 4.75})), Breaks{2});
  EXPECT_EQ(find_chain_breaks(on_a_line({0, 1, 11, 12, 13, 23, 24})), (Breaks{1, 4}));
}

TEST(ChainBreaks, NeedThreeBeads) {
  EXPECT_EQ(find_chain_breaks(on_a_line({})), Breaks{});
  EXPECT_EQ(find_chain_breaks(on_a_line({0})), Breaks{});
  EXPECT_EQ(find_chain_breaks(on_a_line({0, 100})), Breaks{});
}

TEST(ChainBreaks, BeadsInOnePlace) {
  EXPECT_EQ(find_chain_breaks(on_a_line({1, 1, 1, 1})), Breaks{});
  EXPECT_EQ(find_chain_breaks(on_a_line({1, 1, 1, 1, 2})), Breaks{});
}

TEST(ChainBreaks, Description) {
  EXPECT_EQ(describe_chain_breaks("f", {7}), "f: chain break after bead 7 (joined)");
  EXPECT_EQ(describe_chain_breaks("f", {12, 99}), "f: chain breaks after beads 12, 99 (joined)");
  EXPECT_EQ(describe_chain_breaks("f", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}),
            "f: chain breaks after beads 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 and 2 more (joined)");
}

}  // namespace
}  // namespace kds::chain_breaks_test
