#include <gtest/gtest.h>

#include <limits>

#include "motions/frames/frame_selection.h"
#include "tests/motions/test_files.h"

namespace kds::frame_range_test {
namespace {

using Frames = std::vector<std::size_t>;

Frames numbers(const FramesAsked& asked) {
  Frames frames;
  for (std::size_t i = 0; i < asked.count; ++i) frames.push_back(asked[i]);
  return frames;
}

Frames select(std::string_view range, FramesHeld held) {
  std::vector<std::string> warnings;
  return numbers(select_frames("f", parse_frame_range(range), held, false, warnings));
}

TEST(FrameRange, Parse) {
  const FrameRange all = parse_frame_range(":");
  EXPECT_EQ(all.first, 0U);
  EXPECT_FALSE(all.last.has_value());
  EXPECT_EQ(all.stride, 1U);
  const FrameRange some = parse_frame_range("5:100:3");
  EXPECT_EQ(some.first, 5U);
  EXPECT_EQ(some.last, 100U);
  EXPECT_EQ(some.stride, 3U);
  EXPECT_EQ(parse_frame_range("::2").stride, 2U);
  EXPECT_EQ(parse_frame_range("10:").first, 10U);
  EXPECT_EQ(parse_frame_range(":7").last, 7U);
  EXPECT_EQ(parse_frame_range("::").stride, 1U);
}

TEST(FrameRange, Select) {
  EXPECT_EQ(select(":", {3, false}), (Frames{0, 1, 2}));
  EXPECT_EQ(select("1:", {3, false}), (Frames{1, 2}));
  EXPECT_EQ(select("0:5:2", {5, false}), (Frames{0, 2, 4}));
  EXPECT_EQ(select("::18446744073709551615", {5, false}), (Frames{0}));
}

TEST(FrameRange, OpenFramesHaveNoEnd) {
  const FramesHeld open{.open = true};
  EXPECT_EQ(select("3:9:2", open), (Frames{3, 5, 7}));
  std::vector<std::string> warnings;
  for (const char* const range : {":", "7:", "::3", "18446744073709551614::18446744073709551615"}) {
    const FrameRange parsed = parse_frame_range(range);
    const FramesAsked asked = select_frames("f", parsed, open, false, warnings);
    EXPECT_FALSE(asked.truncated || asked.at_rest);
    const std::size_t last = asked[asked.count - 1];
    EXPECT_GE(last, parsed.first);
    EXPECT_LE(std::numeric_limits<std::size_t>::max() - last, parsed.stride);
  }
  EXPECT_TRUE(warnings.empty());
}

TEST(FrameRange, TellsOfFramesBehindTheLastOneThatAStrideMeets) {
  const auto warnings = [](std::string_view range, std::size_t whole) {
    std::vector<std::string> lines;
    (void)select_frames("f", parse_frame_range(range), {whole, false}, false, lines);
    return lines;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings("0:100:7", 200),
            Lines{"f: a stride of 7 ends at frame 98; 1 frame after it is left out"});
  EXPECT_EQ(warnings("::10", 1000),
            Lines{"f: a stride of 10 ends at frame 990; 9 frames after it are left out"});
  EXPECT_TRUE(warnings("0:99:7", 200).empty());
  EXPECT_TRUE(warnings(":5", 200).empty());
  EXPECT_TRUE(warnings("::10", 1).empty());
}

TEST(FrameRange, FramesThatAreNotThere) {
  test::expect_refused([] { (void)select("3:", {3, false}); }, {"--frames", "f", "3 frames"});
  test::expect_refused([] { (void)select(":4", {3, false}); }, {"--frames", "f", "3 frames"});
  test::expect_refused([] { (void)select(":", {0, false}); }, {"f", "no frame"});
  std::vector<std::string> warnings;
  test::expect_refused(
      [&] {
        (void)select_frames("f", FrameRange{0, std::nullopt, 0}, {3, false}, false, warnings);
      },
      {"stride"});
}

TEST(FrameRange, OneFrameIsAtRest) {
  EXPECT_EQ(select("10:60:2", {1, false}), Frames{0});
  test::expect_refused(
      [] {
        (void)select("10:60", {1, true});
      },
      {"frame 10 is asked for", "f holds 1 frame"});
}

TEST(FrameRange, FileThatEndsInsideAFrame) {
  test::expect_refused([] { (void)select(":4", {3, true}); }, {"frames up to 3", "f holds 3 frames"});
  test::expect_refused([] { (void)select(":1", {0, true}); }, {"inside frame 0"});
  for (const char* range : {":", ":3"}) {
    std::vector<std::string> warnings;
    EXPECT_EQ(numbers(select_frames("f", parse_frame_range(range), {3, true, 1234}, false, warnings)),
              (Frames{0, 1, 2}));
    EXPECT_EQ(warnings, std::vector<std::string>{
                            "f: the file ends inside frame 3 (after 1234 bytes); the last whole frame is 2"});
  }
}

TEST(FrameRange, DamagedFrame) {
  const DamagedFrame damage("f", 3, 1234, "expected 7 atoms, found 8");
  const FramesHeld held{3, false, 0, damage};
  test::expect_refused([&] { (void)select(":", held); },
                       {"f: frame 3, byte 1234: expected 7 atoms, found 8"});
  test::expect_refused([&] { (void)select(":4", held); }, {"f: frame 3"});
  EXPECT_EQ(select(":3", held), (Frames{0, 1, 2}));
  for (const char* range : {":", ":9"}) {
    std::vector<std::string> warnings;
    EXPECT_EQ(numbers(select_frames("f", parse_frame_range(range), held, true, warnings)), (Frames{0, 1, 2}));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("frames up to 2 are read (--until-damage)"), std::string::npos);
    EXPECT_TRUE(select_frames("f", parse_frame_range(range), held, true, warnings).truncated);
  }
  std::vector<std::string> none_expected;
  EXPECT_FALSE(select_frames("f", parse_frame_range(":3"), held, true, none_expected).truncated);
  const FramesHeld none{0, false, 0, DamagedFrame("f", 0, 8, "expected 7 atoms, found 8")};
  std::vector<std::string> warnings;
  test::expect_refused([&] { (void)select_frames("f", {}, none, true, warnings); }, {"f: frame 0, byte 8"});
}

}  // namespace
}  // namespace kds::frame_range_test
