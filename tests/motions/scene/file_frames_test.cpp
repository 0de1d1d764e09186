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
    const std::size_t cell = D * (static_cast<std::size_t>(a.degree()) + 1) * D;
    ASSERT_NE(motion_a.cell(), nullptr);
    EXPECT_EQ(std::vector(motion_a.cell(), motion_a.cell() + cell),
              std::vector(motion_b.cell(), motion_b.cell() + cell));
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
        EXPECT_FALSE(streamed.warnings.empty());
        std::erase_if(streamed.warnings,
                      [](const std::string& line) {  // known once all frames have been read
                        return line.find("its path is a guess") != std::string::npos;
                      });
        EXPECT_EQ(streamed.warnings, whole[0].warnings);
        const std::vector<double> radii = bead_radii("auto", whole);
        EXPECT_EQ(bead_radii("auto", streamed.stream->necklaces(), streamed.survey), radii);
        EXPECT_EQ(bead_radii("element", streamed.stream->necklaces(), streamed.survey),
                  bead_radii("element", whole));
        const Scene held(whole, radii, kind);
        const Scene read(std::move(streamed.stream), streamed.survey, radii, kind);
        ASSERT_EQ(read.frame_count(), held.frame_count());
        EXPECT_TRUE(read.is_periodic());
        EXPECT_TRUE(held.is_periodic());
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

TEST(FileFrames, TellsOfAFileThatLosesFramesMeanwhile) {
  std::mt19937 random(19);
  const std::string text = xyz_frames(random, 4000, 10, false);
  const auto path = test::write_file("a.xyz", text);
  Streamed streamed = open({path});
  const Scene scene(std::move(streamed.stream), streamed.survey, std::vector<double>(10, 1));
  std::filesystem::resize_file(path, text.find("10\nframe", text.size() / 2));
  test::expect_refused([&] { (void)scene.centers(3999); }, {"a.xyz: frame", "is gone"});
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
