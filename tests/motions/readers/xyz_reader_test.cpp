#include <gtest/gtest.h>

#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"

namespace kds::xyz_reader_test {
namespace {

Trajectory read(std::string_view text, const ReadOptions& options = {}) {
  return read_trajectory(test::write_file("a.xyz", text), options);
}

void refuse(std::string_view text, std::initializer_list<std::string_view> parts,
            const ReadOptions& options = {}) {
  test::expect_refused([&] { (void)read(text, options); }, parts);
}

constexpr std::string_view two_frames = "2\nfirst\nC 0 0.1 0\nN 1.5 0 0 extra 7\n2\n\nC 0 1 0\nN 1.5 1 0\n";

TEST(XyzReader, ReadsFrames) {
  const Trajectory trajectory = read(two_frames);
  ASSERT_EQ(trajectory.frames.size(), 2U);
  EXPECT_EQ(trajectory.bead_count(), 2U);
  EXPECT_EQ(trajectory.frames[0](1, 0), 0.1);
  EXPECT_EQ(trajectory.frames[1](1, 1), 1);
  EXPECT_EQ(trajectory.element_radii, (std::vector<double>{1.7, 1.55}));
  EXPECT_EQ(trajectory.frame_numbers, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(trajectory.warnings.empty());
}

TEST(XyzReader, SelectsFrames) {
  const Trajectory trajectory = read(two_frames, {.frames = {1, std::nullopt, 1}});
  ASSERT_EQ(trajectory.frames.size(), 1U);
  EXPECT_EQ(trajectory.frame_numbers, (std::vector<std::size_t>{1}));
  EXPECT_EQ(trajectory.frames[0](1, 0), 1);
}

TEST(XyzReader, OneBeadAndCoincidentBeadsAreLegal) {
  EXPECT_EQ(read("1\n\nX 1 2 3\n").bead_count(), 1U);
  EXPECT_TRUE(read("1\n\nX 1 2 3\n").element_radii.empty());
  EXPECT_EQ(read("3\n\nC 1 2 3\nC 1 2 3\nC 1 2 3\n").breaks.size(), 0U);
}

TEST(XyzReader, Refuses) {
  refuse("", {"a.xyz", "no frame"});
  refuse("x\n", {"a.xyz:1:", "number of atoms"});
  refuse("2 3\n\nC 0 0 0\nC 0 0 0\n", {"a.xyz:1:"});
  refuse("0\n\n", {"a.xyz:1:", "at least 1 atom"});
  refuse("2\n\nC 0 0\nC 0 0 0\n", {"a.xyz:3:", "3 fields"});
  refuse("1\n\nC 0 0 z\n1\n\nC 0 0 0\n", {"a.xyz:3:", "'z'"});
  refuse("1\n\nC 0 0 0\n2\n\nC 0 0 0\nC 0 0 1\n", {"a.xyz: frame 1: 2 atoms, expected 1"});
  refuse("1\n\nC 0 0 0\n1\n\nC 0 nan 0\n", {"a.xyz: frame 1: bead 0 has y = nan"});
  refuse("1\n\nC inf 0 0\n", {"a.xyz: frame 0: bead 0 has x = inf"});
  refuse("99999999999999\n\nC 0 0 0\n", {"inside frame 0"});
  refuse(two_frames, {"--select"}, {.selection = Selection::backbone});
  refuse(two_frames, {"--select"}, {.selection = Selection::ca});
  refuse(two_frames, {"--chain"}, {.chain = "A"});
  test::expect_refused([] { (void)read_trajectory("no-such-file.xyz"); },
                       {"no-such-file.xyz", "cannot open"});
}

TEST(XyzReader, FileThatEndsInsideAFrame) {
  const std::string cut(two_frames.substr(0, two_frames.size() - 12));
  refuse(cut, {"inside frame 1", "last whole frame is 0"});
  const Trajectory whole = read(cut, {.frames = {0, 1, 1}});
  EXPECT_EQ(whole.frames.size(), 1U);
  ASSERT_EQ(whole.warnings.size(), 1U);
  EXPECT_NE(whole.warnings[0].find("ends inside frame 1"), std::string::npos);
}

TEST(XyzReader, CutAnywhere) {
  const std::string path = test::temporary("a.xyz").string();
  for (std::size_t size = 0; size < two_frames.size(); ++size) {
    test::write_file("a.xyz", two_frames.substr(0, size));
    try {
      const Trajectory trajectory = read_trajectory(path);
      for (const auto& frame : trajectory.frames) EXPECT_EQ(frame.cols(), 2);
    } catch (const InputError&) {
    }
  }
}

TEST(XyzReader, ExtendedXyz) {
  // The second bead lies beyond the wall.
  const Trajectory trajectory = read(
      "2\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3:id:I:1\nC 9.5 0 0 1\nC 0.75 0 0 "
      "2\n");
  EXPECT_EQ(trajectory.frames[0](0, 1), 10.75);
  ASSERT_EQ(trajectory.warnings.size(), 1U);
  EXPECT_NE(trajectory.warnings[0].find("made whole"), std::string::npos);
  refuse("1\nLattice=\"10 0 0\"\nC 0 0 0\n", {"a.xyz:2:", "9 numbers"});
  refuse("1\nLattice=\"10 0 0 0 10 0 0 0 x\"\nC 0 0 0\n", {"a.xyz:2:", "'x'"});
  refuse("1\nProperties=pos:R:3:species:S:1\n0 0 0 C\n", {"a.xyz:2:", "species:S:1:pos:R:3"});
  // A flat lattice is none.
  EXPECT_TRUE(read("2\nLattice=\"0 0 0 0 0 0 0 0 0\"\nC 9 0 0\nC 1 0 0\n").warnings.empty());
}

TEST(XyzReader, ChainBreaks) {
  std::string text = "6\n\n";
  for (const double x : {0.0, 1.0, 2.0, 12.0, 13.0, 14.0}) text += "C " + std::to_string(x) + " 0 0\n";
  const Trajectory trajectory = read(text);
  EXPECT_EQ(trajectory.breaks, (std::vector<std::size_t>{2}));
  ASSERT_EQ(trajectory.warnings.size(), 1U);
  EXPECT_NE(trajectory.warnings[0].find("chain break after bead 2 (joined)"), std::string::npos);
}

TEST(ReadTrajectory, UnknownEnding) {
  test::expect_refused([] { (void)read_trajectory("a.xtc"); }, {"a.xtc", ".dcd"});
  test::expect_refused([] { (void)read_trajectory("a"); }, {"a", ".pdb"});
}

}  // namespace
}  // namespace kds::xyz_reader_test
