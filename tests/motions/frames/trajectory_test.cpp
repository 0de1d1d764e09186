#include "motions/frames/trajectory.h"

#include <gtest/gtest.h>

namespace kds::trajectory_test {
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
  EXPECT_EQ(find_chain_breaks(on_a_line({0, 1, 11, 12, 13, 23, 24}), {1}), Breaks{4});
  EXPECT_EQ(find_chain_breaks(on_a_line({0, 1, 11, 21, 31}), {1, 2, 3}), Breaks{});
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

Trajectory numbered(std::size_t frames) {
  Trajectory trajectory;
  for (std::size_t k = 0; k < frames; ++k) {
    trajectory.frames.push_back(Eigen::Matrix3Xd::Constant(3, 2, static_cast<double>(k)));
    trajectory.frame_numbers.push_back(10 + k);
    trajectory.times.push_back(0.5 * static_cast<double>(k));
  }
  return trajectory;
}

TEST(EveryNth, KeepsFramesWithTheirNumbers) {
  const Trajectory some = every_nth(numbered(8), 3);
  ASSERT_EQ(some.frames.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(some.frames[k](0, 0), 3.0 * static_cast<double>(k));
  EXPECT_EQ(some.frame_numbers, (std::vector<std::size_t>{10, 13, 16}));
  EXPECT_TRUE(some.times.empty());
}

TEST(EveryNth, OneAtRestAndAllFramesStay) {
  EXPECT_EQ(every_nth(numbered(1), 5).frames.size(), 1U);
  EXPECT_EQ(every_nth(numbered(4), 1).frame_numbers, numbered(4).frame_numbers);
  EXPECT_EQ(every_nth(numbered(4), 9).frames.size(), 1U);
}

}  // namespace
}  // namespace kds::trajectory_test
