// Hermite curves with the velocities of the frames.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/readers/necklace_stream.h"
#include "motions/scene/file_frames.h"
#include "motions/scene/scene.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/cubic_paths.h"
#include "tests/support/inputs/gromacs_files.h"

namespace kds::frame_velocities_test {
namespace {

using test::CubicPaths;
using test::TrrMaker;

/// A scene, what the survey says of its frames, and its warnings.
struct Made {
  FrameSurvey survey;
  std::vector<std::string> warnings;
  std::unique_ptr<Scene> scene;
};

Made made_of(const std::vector<std::filesystem::path>& paths, ReadOptions options = {}) {
  options.velocities = true;
  std::vector<NecklaceStream> files;
  for (const std::filesystem::path& path : paths) files.emplace_back(path, options);
  auto frames = std::make_unique<FileFrames>(std::move(files));
  Made made;
  made.survey =
      survey_frames(*frames, false, [&](const std::string& line) { made.warnings.push_back(line); });
  std::vector<double> radii(count_beads(frames->necklaces()), 1);
  made.scene =
      std::make_unique<Scene>(std::move(frames), made.survey, std::move(radii), FrameMotion::hermite);
  return made;
}

Eigen::Vector3d point_of(const BezierMotion<3, 3>& motion, BeadId bead, double u) {
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis) {
    double value = 0;
    for (int k = 0; k <= 3; ++k)
      value +=
          (k % 3 == 0 ? 1 : 3) * std::pow(u, k) * std::pow(1 - u, 3 - k) * motion.coordinate(bead, k, axis);
    point[axis] = value;
  }
  return point;
}

// Returns how far the scene's beads are at most from their true paths, apart from a shift of each bead by
// whole cells.
double deviation(const Scene& scene, const CubicPaths& paths, std::size_t stride) {
  double most = 0;
  BezierMotion<3, 3> motion(scene.bead_count());
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    scene.load(step, motion);
    const double from = paths.times[step * stride], to = paths.times[(step + 1) * stride];
    for (BeadId bead = 0; bead < scene.bead_count(); ++bead)
      for (const double u : {0.0, 0.125, 0.5, 0.8, 1.0}) {
        const Eigen::Vector3d apart =
            point_of(motion, bead, u) - paths.position(bead, from + u * (to - from));
        most = std::max(most, (apart - paths.cell * (apart / paths.cell).array().round().matrix()).norm());
      }
  }
  return most;
}

TEST(FrameVelocities, GiveCubicPathsUpToRounding) {
  for (const std::size_t stride : {1U, 2U, 3U})
    for (const auto unwrap : {Unwrap::none, Unwrap::chains, Unwrap::beads}) {
      CubicPaths paths;
      if (unwrap != Unwrap::none) paths.cell = 10;  // beads pass through its walls
      const Made made = made_of({test::write_file("a.lammpstrj", paths.dump())},
                                {.frames = {.stride = stride}, .unwrap = unwrap});
      EXPECT_EQ(made.scene->velocities(), VelocitySource::file);
      EXPECT_EQ(made.scene->reach(), 0U);
      EXPECT_LT(deviation(*made.scene, paths, stride), 1e-12) << stride;
    }
}

TEST(FrameVelocities, BesideBeadsAtRest) {
  CubicPaths paths, rest;
  rest.times = {0};
  const auto moving = test::write_file("a.lammpstrj", paths.dump());
  const Made made = made_of({moving, test::write_file("rest.lammpstrj", rest.dump())});
  EXPECT_EQ(made.scene->velocities(), VelocitySource::file);
  BezierMotion<3, 3> motion(14);
  made.scene->load(1, motion);
  EXPECT_EQ(point_of(motion, 13, 0.5), rest.position(6, 0));
  EXPECT_LT((point_of(motion, 6, 0.5) - paths.position(6, 0.625)).norm(), 1e-12);
  TrrMaker still;
  still.has_box = false;
  still.frames.assign(7, std::vector<TrrMaker::Atom>(3));
  const Made other = made_of({moving, test::write_file("b.trr", still.bytes())});
  EXPECT_EQ(other.scene->velocities(), VelocitySource::differences);
}

TEST(FrameVelocities, DtGivesTheTimes) {
  CubicPaths paths;
  paths.times = {0, 0.25, 0.5, 0.75};
  for (const bool has_times : {true, false}) {
    paths.has_times = has_times;
    const Made made = made_of({test::write_file("a.lammpstrj", paths.dump())}, {.time_step = 0.25});
    EXPECT_LT(deviation(*made.scene, paths, 1), 1e-12);
  }
  const auto path = test::write_file("a.lammpstrj", paths.dump());
  EXPECT_EQ(made_of({path}).survey.lacks_velocities, "frame 0 has no time");
}

// Cubics miss no frame of a cubic path with its velocities. With times that are 1000 times too long,
// differences are better.
TEST(FrameVelocities, AreComparedWithDifferences) {
  CubicPaths paths;
  paths.times = {0, 0.25, 0.5, 0.875, 1, 1.25, 1.625, 1.75};
  const auto uneven = test::write_file("a.lammpstrj", paths.dump());
  EXPECT_LT(made_of({uneven}).survey.error_with_velocities, 1e-9);
  paths.times = {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75};
  paths.has_times = false;
  const auto even = test::write_file("b.lammpstrj", paths.dump());
  EXPECT_GT(made_of({even}, {.time_step = 250}).survey.error_with_velocities, 100);
  paths.times.resize(6);
  const auto few = test::write_file("c.lammpstrj", paths.dump());
  EXPECT_EQ(made_of({few}, {.time_step = 250}).survey.error_with_velocities, 1);
}

// Beads that stand still have better differences than velocities, and a plane that velocities leave is a
// plane.
TEST(FrameVelocities, LoseToDifferencesThatAreExact) {
  TrrMaker maker;
  maker.has_box = false;
  maker.has_velocities = true;
  std::string bytes;
  maker.frames.assign(9, std::vector<TrrMaker::Atom>(5));
  for (std::size_t k = 0; k < 9; ++k) {
    for (std::size_t i = 0; i < 5; ++i)
      maker.frames[k][i] = {0.38 * static_cast<double>(i), 0.01 * static_cast<double>(i * i), 0.2};
    bytes += maker.frame_bytes(k);
  }
  FrameSurvey survey = made_of({test::write_file("a.trr", bytes)}).survey;
  EXPECT_GT(survey.error_with_velocities, 1);
  EXPECT_TRUE(survey.velocities);
  EXPECT_FALSE(survey.plane);
  survey.leave_velocities("a reason");
  EXPECT_TRUE(survey.plane);
}

TEST(FrameVelocities, AreThoseOfAllFramesOrOfNone) {
  TrrMaker maker;
  maker.has_box = false;
  maker.frames.assign(4, std::vector<TrrMaker::Atom>(5));
  std::string bytes;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < 5; ++i) maker.frames[k][i] = {0.38 * i, 0.01 * (i * k), 0.02 * (k * k)};
    maker.has_velocities = k != 1;
    bytes += maker.frame_bytes(k);
  }
  const auto path = test::write_file("a.trr", bytes);
  const Made made = made_of({path});
  EXPECT_EQ(made.survey.lacks_velocities, "frame 1 has no velocities");
  EXPECT_EQ(made.scene->velocities(), VelocitySource::differences);
  maker.has_velocities = false;
  const Made without = made_of({test::write_file("b.trr", maker.bytes())});
  EXPECT_EQ(without.survey.lacks_velocities, "");
  BezierMotion<3, 3> one(5), other(5);
  for (std::size_t step = 0; step < 3; ++step) {
    made.scene->load(step, one);
    without.scene->load(step, other);
    for (BeadId bead = 0; bead < 5; ++bead)
      for (int k = 0; k <= 3; ++k) EXPECT_EQ(one.coordinate(bead, k, 2), other.coordinate(bead, k, 2));
  }
  EXPECT_EQ(made_of({path}, {.frames = {.first = 2}}).scene->velocities(), VelocitySource::file);
  maker.has_velocities = true;
  maker.time_step = 0;
  EXPECT_EQ(made_of({test::write_file("a.trr", maker.bytes())}).survey.lacks_velocities,
            "frame 1 is not later than the frame before");
}

TEST(FrameVelocities, MustBeFinite) {
  CubicPaths paths;
  paths.velocity_factor = std::numeric_limits<double>::infinity();
  const auto path = test::write_file("a.lammpstrj", paths.dump());
  test::expect_refused([&] { (void)made_of({path}); }, {"a.lammpstrj: frame 0: bead 0 has vx = ",
                                                        "expected a finite velocity (--velocities"});
}

}  // namespace
}  // namespace kds::frame_velocities_test
