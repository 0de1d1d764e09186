#include "motions/frames/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

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
  for (const std::vector<double>& few : {std::vector<double>{}, {0}, {0, 100}, {1, 1, 1, 1}, {1, 1, 1, 1, 2}})
    EXPECT_EQ(find_chain_breaks(on_a_line(few)), Breaks{});
}

/// The definition, word for word.
Breaks breaks_by_sorting(const Eigen::Matrix3Xd& frame) {
  std::vector<double> lengths;
  for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i)
    lengths.push_back(std::hypot(frame(0, i + 1) - frame(0, i), frame(1, i + 1) - frame(1, i),
                                 frame(2, i + 1) - frame(2, i)));
  std::vector<double> sorted = lengths;
  std::sort(sorted.begin(), sorted.end());
  const double median = (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  Breaks breaks;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (median > 0 && lengths[i] > 1.5 * median) breaks.push_back(i);
  return breaks;
}

TEST(ChainBreaks, BondsOfAllRatiosAndSizes) {
  std::mt19937 random(1);
  const auto uniform = [&] { return std::uniform_real_distribution<double>()(random); };
  std::size_t broken = 0, whole = 0;
  for (int round = 0; round < 2000; ++round) {
    const double size = std::pow(10, 600 * uniform() - 300),
                 ratio = 1 + uniform() * (round % 2 == 0 ? 0.7 : 3);
    Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, 3 + round % 7);
    for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i)
      frame.col(i + 1) =
          frame.col(i) + size * (1 + (ratio - 1) * uniform()) * Eigen::Vector3d(0.36, 0.48, 0.8);
    const Breaks breaks = find_chain_breaks(frame);
    EXPECT_EQ(breaks, breaks_by_sorting(frame)) << "size " << size << ", ratio " << ratio;
    (breaks.empty() ? whole : broken) += 1;
  }
  EXPECT_GT(whole, 100);
  EXPECT_GT(broken, 100);
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
