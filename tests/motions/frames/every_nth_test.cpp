#include "motions/frames/every_nth.h"

#include <gtest/gtest.h>

namespace kds::every_nth_test {
namespace {

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
}  // namespace kds::every_nth_test
