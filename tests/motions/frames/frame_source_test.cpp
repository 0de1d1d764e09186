#include "motions/frames/frame_source.h"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "tests/motions/test_files.h"

namespace kds::frame_source_test {
namespace {

Trajectory necklace(const std::string& file, Eigen::Index beads, std::size_t frames) {
  Trajectory made;
  made.file = file;
  for (std::size_t k = 0; k < frames; ++k) {
    made.frames.emplace_back(Eigen::Matrix3Xd::Random(3, beads));
    made.frame_numbers.push_back(10 + 2 * k);
    made.times.push_back(0.5 * static_cast<double>(k));
  }
  return made;
}

TEST(NecklaceBeads, AreNumberedNecklaceAfterNecklace) {
  const std::vector<NecklaceBeads> necklaces{{.count = 2}, {.count = 1, .names = {"CA"}}, {.count = 3}};
  EXPECT_EQ(count_beads(necklaces), 6U);
  EXPECT_EQ(bead_ranges(necklaces), (std::vector<BeadRange>{{0, 1}, {2, 2}, {3, 5}}));
  EXPECT_EQ(names_of_beads(necklaces), (std::vector<std::string>{"", "", "CA", "", "", ""}));
  EXPECT_TRUE(names_of_beads(std::vector<NecklaceBeads>{{.count = 2}}).empty());
}

TEST(MemoryFrames, PutNecklacesSideBySide) {
  const std::vector<Trajectory> necklaces{necklace("rests", 2, 1), necklace("moves", 3, 4)};
  MemoryFrames frames(necklaces);
  EXPECT_EQ(frames.frame_count(), 4U);
  EXPECT_EQ(frames.necklaces()[1].count, 3U);
  FrameRead frame;
  for (const std::size_t start : {0U, 2U, 1U, 3U}) {
    frames.seek(start);
    for (std::size_t k = start; k < 4; ++k) {
      ASSERT_TRUE(frames.next(frame));
      EXPECT_EQ(frame.positions.leftCols(2), necklaces[0].frames[0]);
      EXPECT_EQ(frame.positions.rightCols(3), necklaces[1].frames[k]);
      EXPECT_EQ(frame.stamp.number, 10 + 2 * k);
      EXPECT_EQ(frame.stamp.picoseconds, 0.5 * static_cast<double>(k));
    }
    EXPECT_FALSE(frames.next(frame));
  }
}

TEST(MemoryFrames, ReadTheCallersArrayInPlace) {
  std::array<double, 12> numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  MemoryFrames frames({{.file = "array", .count = 2}}, numbers, {{0, {}}, {1, 7.5}});
  numbers[11] = -12;  // the array is not copied
  FrameRead frame;
  ASSERT_TRUE(frames.next(frame));
  EXPECT_EQ(frame.positions.col(1), Eigen::Vector3d(4, 5, 6));
  ASSERT_TRUE(frames.next(frame));
  EXPECT_EQ(frame.positions.col(1), Eigen::Vector3d(10, 11, -12));
  EXPECT_EQ(frame.stamp.picoseconds, 7.5);
}

TEST(MemoryFrames, RefuseFramesThatDoNotFit) {
  std::vector<Trajectory> unequal{necklace("long", 2, 3), necklace("short", 2, 2)};
  test::expect_refused([&] { MemoryFrames frames(unequal); }, {"short: 2 frames, but long has 3"});
  std::vector<Trajectory> changing{necklace("changing", 2, 3)};
  changing[0].frames[2] = Eigen::Matrix3Xd::Zero(3, 1);
  test::expect_refused([&] { MemoryFrames frames(changing); }, {"changing: frame 14: 1 bead, expected 2"});
  std::vector<Trajectory> infinite{necklace("a", 2, 3), necklace("b", 3, 3)};
  infinite[1].frames[1](2, 1) = std::numeric_limits<double>::infinity();
  test::expect_refused([&] { MemoryFrames frames(infinite); }, {"b: frame 12, bead 1: expected"});
  const std::array<double, 5> five{};
  test::expect_refused(
      [&] {
        MemoryFrames frames({{.count = 1}}, five, {{}, {}});
      },
      {"2 frames of 1 bead: expected 6 coordinates, found 5"});
}

TEST(FrameQueue, HandsOutEachFrameOnce) {
  FrameQueue queue({{.count = 2}}, 2);
  FrameRead frame;
  EXPECT_FALSE(queue.next(frame));
  EXPECT_TRUE(queue.is_open());
  for (int k = 0; k < 4; ++k) queue.push(std::array<double, 4>{1.0 * k, 2, 3, 4}, 0.25 * k);
  ASSERT_TRUE(queue.next(frame));
  EXPECT_EQ(frame.positions.col(1), Eigen::Vector3d(3, 4, 0));
  queue.seek(2);
  ASSERT_TRUE(queue.next(frame));
  EXPECT_EQ(frame.positions.col(0), Eigen::Vector3d(2, 2, 0));
  EXPECT_EQ(frame.stamp.number, 2U);
  EXPECT_EQ(frame.stamp.picoseconds, 0.5);
  test::expect_refused([&] { queue.seek(2); },
                       {"frame 2 is gone: only pushed frames from frame 3 on are kept"});
  test::expect_refused([&] { queue.seek(5); }, {"frame 5 is not pushed yet: 4 frames pushed so far"});
  queue.end();
  EXPECT_FALSE(queue.is_open());
  EXPECT_TRUE(queue.next(frame));
  EXPECT_FALSE(queue.next(frame));
  EXPECT_THROW(queue.push(std::array<double, 4>{}), std::logic_error);
}

TEST(FrameQueue, IgnoresAFrameThatItRefuses) {
  FrameQueue queue({{.count = 2}}, 1);
  queue.push(std::array<double, 2>{1, 2});
  test::expect_refused([&] { queue.push(std::array<double, 3>{}); },
                       {"frame 1: expected 1 coordinate of 2 beads, 2 numbers, found 3"});
  test::expect_refused(
      [&] {
        queue.push(std::array<double, 2>{0, std::numeric_limits<double>::quiet_NaN()});
      },
      {"frame 1, bead 1: expected finite coordinates"});
  queue.push(std::array<double, 2>{3, 4});
  FrameRead frame;
  ASSERT_TRUE(queue.next(frame));
  ASSERT_TRUE(queue.next(frame));
  EXPECT_EQ(frame.stamp.number, 1U);
  EXPECT_EQ(frame.positions(0, 1), 4);
  EXPECT_FALSE(queue.next(frame));
}

}  // namespace
}  // namespace kds::frame_source_test
