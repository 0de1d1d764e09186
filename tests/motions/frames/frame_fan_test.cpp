#include "motions/frames/frame_fan.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "motions/base/input_error.h"
#include "tests/support/inputs/frames_one_by_one.h"

namespace kds::frame_fan_test {
namespace {

using namespace test;

/// A source of frames of one bead whose x is the number of the frame. Frame `fault` is not finite.
FramesOneByOne source_of(std::size_t count, std::size_t fault = 99) {
  std::vector<FrameRead> frames(count);
  for (std::size_t k = 0; k < count; ++k) {
    frames[k].stamp.number = k;
    frames[k].positions = Eigen::Matrix3Xd::Constant(3, 1, k == fault ? NAN : static_cast<double>(k));
  }
  return {{{.count = 1}}, std::move(frames)};
}

TEST(FrameFan, GivesEachBranchItsFrames) {
  FramesOneByOne source = source_of(50);
  FrameFan fan(source);
  const std::vector<std::size_t> strides{1, 1, 3, 7};
  std::vector<std::vector<FrameRead>> seen(strides.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < strides.size(); ++i)
    threads.emplace_back([&seen, i, branch = fan.branch(strides[i])] { seen[i] = all_frames(*branch); });
  EXPECT_EQ(fan.pump(), 50U);
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < strides.size(); ++i) {
    ASSERT_EQ(seen[i].size(), (50 + strides[i] - 1) / strides[i]);
    for (std::size_t k = 0; k < seen[i].size(); ++k) {
      EXPECT_EQ(seen[i][k].stamp.number, k * strides[i]);
      EXPECT_EQ(seen[i][k].positions(0, 0), static_cast<double>(k * strides[i]));
    }
  }
}

TEST(FrameFan, EndsWithItsSourceItsBranchesOrAtOnce) {
  FramesOneByOne faulty = source_of(20, 2);
  FrameFan broken(faulty);
  const auto branch = broken.branch(1);
  EXPECT_THROW(static_cast<void>(broken.pump()), InputError);
  EXPECT_EQ(all_frames(*branch).size(), 2U);
  EXPECT_FALSE(branch->is_open());

  FramesOneByOne whole = source_of(20);
  FrameFan left(whole);
  left.branch(1).reset();
  static_cast<void>(left.pump());  // returns although no branch is left

  FramesOneByOne again = source_of(20);
  FrameFan stopped(again);
  const auto never_read = stopped.branch(1);
  std::thread other([&] { stopped.stop(); });
  static_cast<void>(stopped.pump());
  other.join();
}

}  // namespace
}  // namespace kds::frame_fan_test
