// A scene that reads its frames on demand equals the scene that holds all frames.

#include "motions/scene/file_frames.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <random>

#include "motions/curves/bezier_motion.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "motions/scene/scene.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/gro_text.h"

namespace kds::file_frames_test {
namespace {

std::string xyz_frames(std::mt19937& random, std::size_t frames, std::size_t beads, bool flat,
                       const std::string& comment = "frame") {
  std::string text;
  for (std::size_t k = 0; k < frames; ++k) {
    text += std::to_string(beads) + "\n" + comment + "\n";
    for (std::size_t b = 0; b < beads; ++b) {
      const auto number = [&] { return std::to_string(static_cast<int>(random() % 4001) - 2000) + "e-2"; };
      text += "C " + number() + " " + (flat ? std::string("3.5") : number()) + " " + number() + "\n";
    }
  }
  return text;
}

struct Streamed {
  std::unique_ptr<FileFrames> stream;
  FrameSurvey survey;
  std::vector<std::string> warnings;
};

Streamed open(const std::vector<std::filesystem::path>& paths, const ReadOptions& options = {}) {
  std::vector<NecklaceStream> files;
  for (const auto& path : paths) files.emplace_back(path, options);
  Streamed streamed;
  streamed.stream = std::make_unique<FileFrames>(std::move(files));
  streamed.survey = survey_frames(*streamed.stream, true,
                                  [&](const std::string& warning) { streamed.warnings.push_back(warning); });
  return streamed;
}

template <int D>
void expect_same_steps(const Scene& a, const Scene& b, const std::vector<std::size_t>& steps) {
  AnyDegreeMotion<D> motion_a(a.bead_count(), a.degree()), motion_b(b.bead_count(), b.degree());
  for (const std::size_t step : steps) {
    a.load(step, motion_a);
    b.load(step, motion_b);
    for (BeadId bead = 0; bead < a.bead_count(); ++bead)
      for (int k = 0; k <= a.degree(); ++k)
        for (int axis = 0; axis < D; ++axis)
          ASSERT_EQ(motion_a.coordinate(bead, k, axis), motion_b.coordinate(bead, k, axis))
              << "step " << step << ", bead " << bead;
    EXPECT_EQ(a.centers(step + 1), b.centers(step + 1));
    EXPECT_EQ(a.frame_number(step), b.frame_number(step));
    EXPECT_EQ(a.stamp(step).picoseconds, b.stamp(step).picoseconds);
  }
}

TEST(FileFrames, IsTheSceneOfAllFramesAtOnce) {
  std::mt19937 random(17);
  for (const bool flat : {false, true}) {
    const auto moving =
        test::write_file("moving.xyz", xyz_frames(random, 9, 5, flat, "Lattice=\"8 0 0 0 8 0 0 0 8\""));
    const auto resting = test::write_file("resting.xyz", xyz_frames(random, 1, 3, flat));
    for (const FrameMotion kind : {FrameMotion::linear, FrameMotion::hermite}) {
      for (const FrameRange range : {FrameRange{}, FrameRange{1, 8, 2}}) {
        const ReadOptions options{.frames = range};
        std::vector<Trajectory> whole{read_trajectory(moving, options), read_trajectory(resting, options)};
        Streamed streamed = open({moving, resting}, options);
        EXPECT_EQ(streamed.warnings, whole[0].warnings);
        EXPECT_FALSE(streamed.warnings.empty());
        const std::vector<double> radii = bead_radii("auto", whole);
        EXPECT_EQ(bead_radii("auto", streamed.stream->necklaces(), streamed.survey), radii);
        EXPECT_EQ(bead_radii("element", streamed.stream->necklaces(), streamed.survey),
                  bead_radii("element", whole));
        const Scene held(whole, radii, kind);
        const Scene read(std::move(streamed.stream), streamed.survey, radii, kind);
        ASSERT_EQ(read.frame_count(), held.frame_count());
        ASSERT_EQ(read.dimension(), held.dimension());
        ASSERT_EQ(read.dimension(), flat ? 2 : 3);
        std::vector<std::size_t> steps;
        for (std::size_t step = 0; step < held.step_count(); ++step) steps.push_back(step);
        steps.insert(steps.end(), {0, 2, 1, 1, 0});  // back and forth
        if (flat) {
          expect_same_steps<2>(read, held, steps);
        } else {
          expect_same_steps<3>(read, held, steps);
        }
        EXPECT_EQ(read.in_input({1, 2, 0}), held.in_input({1, 2, 0}));
      }
    }
  }
}

TEST(FileFrames, RefusesUnlikeFrameCountsAndFramesThatAreNone) {
  std::mt19937 random(18);
  const auto three = test::write_file("three.xyz", xyz_frames(random, 3, 4, false));
  const auto two = test::write_file("two.xyz", xyz_frames(random, 2, 4, false));
  test::expect_refused([&] { (void)open({two, three}); }, {"two.xyz: 2 frames", "three.xyz has 3"});
  const auto late = test::write_file("late.xyz", xyz_frames(random, 3, 1, false) + "1\nlate\nC 0 inf 0\n");
  test::expect_refused([&] { (void)open({late}); }, {"late.xyz: frame 3: bead 0 has y = inf"});
  const auto one = test::write_file("one.xyz", xyz_frames(random, 1, 4, false));
  test::expect_refused(
      [&] {
        Streamed streamed = open({one});
        const Scene scene(std::move(streamed.stream), streamed.survey, std::vector<double>(4, 1));
      },
      {"one.xyz", "at least two frames"});
}

// A range or a stride that selects one frame of a longer file does not put it to rest.
TEST(FileFrames, OnlyFilesOfOneFrameAreAtRest) {
  std::mt19937 random(20);
  const auto three = test::write_file("three.xyz", xyz_frames(random, 3, 4, false));
  const auto six = test::write_file("six.xyz", xyz_frames(random, 6, 4, false));
  const auto one = test::write_file("one.xyz", xyz_frames(random, 1, 4, false));
  for (const FrameRange& range : {FrameRange{2, std::nullopt, 1}, {0, std::nullopt, 4}}) {
    const ReadOptions options{.frames = range};
    test::expect_refused([&] { (void)open({three, six}, options); }, {"three.xyz: 1 frame", "six.xyz has"});
    EXPECT_GT(open({one, six}, options).survey.frame_count, 1U);
  }
  const ReadOptions of_one{.frames = {2, 3, 1}};
  EXPECT_EQ(open({three, six}, of_one).survey.frame_count, 1U);
}

TEST(FileFrames, TellsOfAFileThatLosesFramesMeanwhile) {
  std::mt19937 random(19);
  const std::string text = xyz_frames(random, 4000, 10, false);
  const auto path = test::write_file("a.xyz", text);
  Streamed streamed = open({path});
  const Scene scene(std::move(streamed.stream), streamed.survey, std::vector<double>(10, 1));
  std::filesystem::resize_file(path, text.find("10\nframe", text.size() / 2));
  test::expect_refused([&] { (void)scene.centers(3999); }, {"a.xyz: frame", "is gone"});
}

// Two files in one cell; the second chain is on the other side of a wall.
TEST(FileFrames, TellsOfNearerImagesInOneCell) {
  const auto warnings = [](double y, std::string_view lattice) {
    const auto frame = [&](double height, std::string_view cell) {
      return "2\nLattice=\"" + std::string(cell) + "\"\nC 1 " + std::to_string(height) + " 0\nC 2 " +
             std::to_string(height) + " 0\n";
    };
    const auto first = test::write_file("first.xyz", frame(1, "20 20 20") + frame(1.5, "20 20 20"));
    const auto other = test::write_file("other.xyz", frame(y, lattice) + frame(y, lattice));
    std::vector<NecklaceStream> files;
    for (const auto& path : {first, other}) files.emplace_back(path, ReadOptions());
    std::vector<std::string> lines;
    FileFrames frames(std::move(files));
    (void)survey_frames(frames, false, [&](const std::string& line) { lines.push_back(line); });
    return lines;
  };
  ASSERT_EQ(warnings(18, "20 20 20").size(), 1U);
  EXPECT_NE(warnings(18, "20 20 20")[0].find("(3 away, not 17)"), std::string::npos);
  EXPECT_TRUE(warnings(5, "20 20 20").empty());
  EXPECT_TRUE(warnings(18, "21 20 20").empty());
}

// Each later necklace is compared with all earlier ones, not only with the first file.
TEST(FileFrames, TellsOfNearerImagesOfAnyEarlierNecklace) {
  const auto file = [](const std::string& name, double y, double box) {
    const std::string frame = "2\nLattice=\"" + std::to_string(box) + " 40 40\"\nC 1 " + std::to_string(y) +
                              " 0\nC 2 " + std::to_string(y) + " 0\n";
    return test::write_file(name, frame + frame);
  };
  const auto first = file("first.xyz", 13, 40), low = file("low.xyz", 1, 40), high = file("high.xyz", 38, 40);
  EXPECT_TRUE(open({first, low}).warnings.empty());
  EXPECT_TRUE(open({first, high}).warnings.size() == 1U);  // 15 apart, not 25
  const std::vector<std::string> warnings = open({first, low, high}).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("high.xyz: has a periodic image much nearer to the necklaces before it (3 away, "
                             "not 25)"),
            std::string::npos)
      << warnings[0];
  // Necklaces with equal cells are compared, whatever cell the first file has.
  const auto other = file("other.xyz", 13, 41);
  EXPECT_EQ(open({other, low, high}).warnings.size(), 1U);
  EXPECT_TRUE(open({other, low}).warnings.empty());
}

// A chain of a later file is reported even if another chain of that file needs no image.
TEST(FileFrames, TellsOfNearerImagesOfEachChain) {
  const auto models = [](const std::string& name, const std::vector<double>& heights) {
    std::string text;
    for (int k = 0; k < 2; ++k) {
      text += "CRYST1   40.000   40.000   40.000  90.00  90.00  90.00 P 1\nMODEL        1\n";
      for (std::size_t n = 0; n < heights.size(); ++n)
        for (int atom = 0; atom < 3; ++atom)
          text += test::pdb_line({.name = std::array{"N", "CA", "C"}[static_cast<std::size_t>(atom)],
                                  .chain = static_cast<char>('A' + n),
                                  .x = 1.4 * atom,
                                  .y = heights[n]});
      text += "ENDMDL\n";
    }
    return test::write_file(name, text);
  };
  std::vector<NecklaceStream> files;
  files.emplace_back(models("a.pdb", {12, 2}), ReadOptions{.chain = "A,B"});
  files.emplace_back(models("b.pdb", {19, 37}), ReadOptions{.chain = "A,B"});
  std::vector<std::string> warnings;
  FileFrames frames(std::move(files));
  (void)survey_frames(frames, false, [&](const std::string& line) { warnings.push_back(line); });
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("b.pdb chain B: has a periodic image much nearer to the necklaces before it (5 "
                             "away, not 18)"),
            std::string::npos)
      << warnings[0];
}

std::vector<std::optional<double>> times_of(const std::vector<std::filesystem::path>& paths,
                                            std::vector<std::string>& warnings) {
  const Streamed streamed = open(paths);
  streamed.stream->seek(0);
  std::vector<std::optional<double>> times;
  for (FrameRead frame; streamed.stream->next(frame);) times.push_back(frame.stamp.picoseconds);
  warnings = streamed.warnings;
  return times;
}

TEST(FileFrames, TimesOfInputsSideBySide) {
  using Times = std::vector<std::optional<double>>;
  std::mt19937 random(20);
  const auto gro = [](const std::string& name, const std::vector<double>& of_frames) {
    return test::write_file(name, test::gro_with_times(of_frames));
  };
  const auto one = gro("one.gro", {0, 1, 2}), other = gro("other.gro", {0, 1.5, 3});
  const auto alike = gro("alike.gro", {0, 1.0000005, 2}), resting = gro("resting.gro", {7});
  const auto untimed = test::write_file("untimed.xyz", xyz_frames(random, 3, 4, false));
  std::vector<std::string> warnings;
  EXPECT_EQ(times_of({one, other}, warnings), (Times{0, 1, 2}));
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [](const std::string& line) {
                            return line.find("other.gro: frame 1 has the time 1.5 ps, frame 1 of ") !=
                                       std::string::npos &&
                                   line.find("one.gro beside it 1 ps") != std::string::npos &&
                                   line.find("(2 frames") != std::string::npos;
                          }),
            1);
  // A file without times takes those of another, and a file at rest gives none.
  for (const auto& paths : std::vector<std::vector<std::filesystem::path>>{
           {untimed, one}, {one, untimed}, {resting, one}, {untimed, resting, one}, {one, alike}}) {
    EXPECT_EQ(times_of(paths, warnings), (Times{0, 1, 2}));
    for (const std::string& line : warnings) EXPECT_EQ(line.find("has the time"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace kds::file_frames_test
