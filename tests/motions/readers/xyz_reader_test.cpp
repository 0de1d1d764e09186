#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>

#include "tests/motions/reader_files.h"

namespace kds::xyz_reader_test {
namespace {

constexpr test::FileReader read{"a.xyz"};
constexpr test::FileRefusal refuse{"a.xyz"};

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

TEST(XyzReader, OneBeadAndCoincidentBeadsAreLegal) {
  EXPECT_EQ(read("1\n\nX 1 2 3\n").bead_count(), 1U);
  EXPECT_EQ(read("1\n\nC.3 1 2 3\n").frames[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(read("1\n\nX 1 2 3\n").element_radii.empty());
  EXPECT_EQ(read("3\n\nC 1 2 3\nC 1 2 3\nC 1 2 3\n").breaks.size(), 0U);
}

// A number that is cut off must not be read as another one.
TEST(XyzReader, LastNumberWithoutLineEnd) {
  const auto frame = [](const std::string& last) {
    const bool has_further_column = last.find(" 0") != std::string::npos;
    return fmt::format("2\n\nC 0.125 1.000 0.500{}\nC 1.250 0.125 {}", has_further_column ? " 0" : "", last);
  };
  for (const std::string last : {"2", "2.", "2.3", "2.34"}) {
    const Trajectory before = read(frame("2.345\n") + frame(last));
    EXPECT_EQ(before.frames.size(), 1U) << last;
    EXPECT_TRUE(before.truncated) << last;
    EXPECT_THAT(before.warnings, testing::ElementsAre(testing::HasSubstr("expected a line end"))) << last;
    refuse(frame(last), {"ends inside frame 0", "expected a line end"});
  }
  // All decimals are there, or something after the number shows that it is whole.
  for (const std::string last : {"2.345", "2 ", "2.3 0", "2.3\t"})
    for (const std::string& text : {frame("2.345\n") + frame(last), frame(last)}) {
      const Trajectory all = read(text);
      EXPECT_EQ(all.frames.back()(2, 1), std::stod(last)) << text;
      EXPECT_TRUE(!all.truncated && all.warnings.empty()) << text;
    }
  EXPECT_EQ(read("2\n\nC 0 0 0 1.25 1.25\nC 1.5 0 2.3 1.2").frames[0](2, 1), 2.3) << "cut off behind it";
}

TEST(XyzReader, ExtendedXyz) {
  // The second bead lies beyond the wall.
  const Trajectory trajectory = read(
      "2\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3:id:I:1\nC 9.5 0 0 1\nC 0.75 0 0 "
      "2\n");
  EXPECT_EQ(trajectory.frames[0](0, 1), 10.75);
}

TEST(XyzReader, CommentsTellTheColumns) {
  struct Case {
    std::string_view comment, line;
  };
  for (const Case& one : std::initializer_list<Case>{
           {"", "C 1 2 3 9 9 9"},
           // Comments of any text.
           {"it's 5\" wide = no", "C 1 2 3 4 5"},
           {"\"open", "C 1 2 3"},
           {"= = =", "C 1 2 3"},
           {"a=", "C 1 2 3"},
           {"\\", "C 1 2 3"},
           {"E=[1,2", "C 1 2 3"},
           {"x={", "C 1 2 3"},
           {"step 3, Lattice of nothing", "C 1 2 3"},
           {"'", "C 1 2 3"},
           {"1 C 0 0 0 1", "C 1 2 3"},
           {"Properties = id:I:1:species:S:1:pos:R:3", "1 C 1 2 3"},
           {"Properties=pos:R:3:species:S:1", "1 2 3 C"},
           {"properties=pos:R:3", "1 2 3"},
           {"PROPERTIES=\"pos:R:3:Z:I:1\"", "1 2 3 6"},
           {"Properties='species:S:1:pos:R:3:forces:R:3'", "C 1 2 3 9 9 9"},
           {"Properties=species:S:1:move_mask:L:1:pos:R:3", "C T 1 2 3"},
           {"Properties=velo:R:3:Pos:R:3:Species:S:1", "7 8 9 1 2 3 C"},
           {"Lattice=\"90 0 0 0 90 0 0 0 90\" Properties=species:S:1:pos:R:3:tag:S:2", "C 1 2 3 a b"},
           {"Properties =species:S:1:pos:R:3", "C 1D0 2.0d+00 3e0"},
           {"Properties= species:S:1:mass:R:1:pos:R:3", "C 12.011 1 2 3"}}) {
    const std::string text = "1\n" + std::string(one.comment) + "\n" + std::string(one.line) + "\n";
    const Trajectory trajectory = read(text + text);
    ASSERT_EQ(trajectory.frames.size(), 2U) << one.comment;
    EXPECT_EQ(trajectory.frames[1], Eigen::Vector3d(1, 2, 3)) << one.comment;
    EXPECT_EQ(trajectory.element_radii.empty(), one.line.find_first_of("C6") == std::string_view::npos)
        << one.comment;
    EXPECT_TRUE(trajectory.warnings.empty()) << one.comment;
  }
}

TEST(XyzReader, AtomNamesAreNoElements) {
  const auto radii = [](std::initializer_list<std::string_view> symbols, bool told) {
    std::string text = std::to_string(symbols.size()) + "\n\n";
    double x = 0;
    for (const std::string_view symbol : symbols)
      text += std::string(symbol) + " " + std::to_string(x += 1.5) + " 0 0\n";
    const Trajectory trajectory = read(text);
    EXPECT_EQ(!trajectory.warnings.empty(), told) << text;
    return trajectory.element_radii;
  };
  using Radii = std::vector<double>;
  EXPECT_EQ(radii({"N", "CA", "C", "N", "CA", "C"}, true), (Radii{1.55, 1.7, 1.7, 1.55, 1.7, 1.7}));
  EXPECT_EQ(radii({"N", "CA", "C", "O"}, true), (Radii{1.55, 1.7, 1.7, 1.52}));
  EXPECT_EQ(radii({"CA", "CA", "CA"}, true), (Radii{1.7, 1.7, 1.7}));
  EXPECT_EQ(radii({"N", "CA", "C", "O", "CB", "CG1", "CD"}, true),
            (Radii{1.55, 1.7, 1.7, 1.52, 1.7, 1.7, 1.7}));
  EXPECT_EQ(radii({"CB", "HB3", "SG"}, false), (Radii{1.7, 1.2, 1.8}));
  EXPECT_EQ(radii({"NE", "CZ", "NH1"}, true), (Radii{1.55, 1.7, 1.55}));
  EXPECT_EQ(radii({"HG", "OG", "CB"}, true), (Radii{1.2, 1.52, 1.7}));
  EXPECT_EQ(radii({"Ca", "C", "O"}, false), (Radii{2.31, 1.7, 1.52}));
  EXPECT_EQ(radii({"CA", "C", "O", "O", "O"}, true),
            (Radii{2.31, 1.7, 1.52, 1.52, 1.52}));  // calcium carbonate
  EXPECT_EQ(radii({"6", "7", "8"}, false), (Radii{1.7, 1.55, 1.52}));
  EXPECT_EQ(radii({"NA", "CL"}, false), (Radii{2.27, 1.75}));
  EXPECT_EQ(radii({"BB", "SC1"}, false), Radii{});
}

TEST(XyzReader, GzippedFileThatIsCutOff) {
  std::string text;
  std::mt19937 random(1);
  for (int frame = 0; frame < 200; ++frame) {
    text += "3\n\n";
    for (int atom = 0; atom < 3; ++atom)
      text += "C " + std::to_string(random()) + " 0 " + std::to_string(random()) + "\n";
  }
  const std::string bytes = test::read_bytes(test::write_gzipped("a.xyz.gz", text));
  for (const double share : {0.2, 0.5, 0.9}) {
    const auto path = test::write_file(
        "cut.xyz.gz", std::string_view(bytes).substr(
                          0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    const Trajectory whole = read_trajectory(path);
    EXPECT_GT(whole.frames.size(), 10U);
    ASSERT_FALSE(whole.warnings.empty());
    EXPECT_NE(whole.warnings[0].find("cut.xyz.gz: the file ends inside frame"), std::string::npos);
    EXPECT_EQ(read_trajectory(path, {.frames = {0, 10, 1}}).frames.size(), 10U);
  }
}

TEST(ReadTrajectory, TimesOfATimeStep) {
  const auto path = test::write_file("a.xyz", std::string(two_frames) + std::string(two_frames));
  EXPECT_TRUE(read_trajectory(path).times.empty());
  EXPECT_EQ(read_trajectory(path, {.time_step = 2.5}).times, (std::vector<double>{0, 2.5, 5, 7.5}));
  EXPECT_EQ(read_trajectory(path, {.frames = {1, std::nullopt, 2}, .time_step = 2.5}).times,
            (std::vector<double>{2.5, 7.5}));
}

}  // namespace
}  // namespace kds::xyz_reader_test
