// Scenes of the same frames from memory, from an array, from files and pushed one by one have the same steps,
// bit for bit.

#include "motions/scene/discrete_step_adapter.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/readers/necklace_stream.h"
#include "motions/scene/file_frames.h"
#include "motions/scene/scene.h"
#include "motions/scene/straightened_frames.h"
#include "tests/motions/test_files.h"

namespace kds::discrete_step_adapter_test {
namespace {

constexpr FrameMotion kinds[] = {FrameMotion::linear, FrameMotion::hermite, FrameMotion::lifted};
constexpr std::size_t frame_count = 7;
constexpr Eigen::Index beads = 5;

std::vector<Eigen::Matrix3Xd> random_frames(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Eigen::Matrix3Xd> frames;
  for (std::size_t k = 0; k < frame_count; ++k)
    frames.emplace_back(Eigen::Matrix3Xd::NullaryExpr(
        3, beads, [&] { return std::uniform_real_distribution<double>(-9, 9)(random); }));
  return frames;
}

Trajectory trajectory_of(const std::vector<Eigen::Matrix3Xd>& frames) {
  Trajectory trajectory;
  trajectory.file = "frames";
  trajectory.frames = frames;
  return trajectory;
}

const std::vector<double> radii{0.5, 1, 1.5, 2, 0.25};

/// A scene, and the array that its frames may be a view of.
struct Made {
  std::string name;
  std::unique_ptr<Scene> scene;
  std::vector<double> array = {};
};

std::unique_ptr<Scene> scene_of(std::unique_ptr<FrameSource> source, FrameMotion kind) {
  const FrameSurvey survey = survey_frames(*source, false);
  return std::make_unique<Scene>(std::move(source), survey, radii, kind);
}

Made from_array(const std::vector<Eigen::Matrix3Xd>& frames, FrameMotion kind) {
  Made made{"array", nullptr, {}};
  std::vector<FrameStamp> stamps;
  for (const Eigen::Matrix3Xd& frame : frames) {
    made.array.insert(made.array.end(), frame.data(), frame.data() + frame.size());
    stamps.push_back({stamps.size(), {}});
  }
  const std::vector<NecklaceBeads> necklaces{{.file = "array", .count = beads}};
  made.scene = scene_of(std::make_unique<MemoryFrames>(necklaces, made.array, stamps), kind);
  return made;
}

Made from_file(const std::vector<Eigen::Matrix3Xd>& frames, FrameMotion kind) {
  std::string text;
  for (const Eigen::Matrix3Xd& frame : frames) {
    text += fmt::format("{}\n\n", beads);
    for (const auto& bead : frame.colwise())
      text += fmt::format("C {:.17g} {:.17g} {:.17g}\n", bead[0], bead[1], bead[2]);
  }
  std::vector<NecklaceStream> files;
  files.emplace_back(test::write_file("frames.xyz", text), ReadOptions());
  return {"file", scene_of(std::make_unique<FileFrames>(std::move(files)), kind)};
}

Scene from_memory(const std::vector<Eigen::Matrix3Xd>& frames, FrameMotion kind) {
  const Trajectory trajectory = trajectory_of(frames);
  return Scene(std::span(&trajectory, 1), radii, kind);
}

std::span<const double> numbers_of(const Eigen::Matrix3Xd& frame) {
  return {frame.data(), static_cast<std::size_t>(frame.size())};
}

/// Returns all numbers of a step: control points, weights, radii, and the drift of a lifted motion.
template <class M>
std::vector<double> numbers_in(const Scene& scene, std::size_t step, M motion) {
  scene.load(step, motion);
  std::vector<double> numbers;
  for (BeadId b = 0; b < scene.bead_count(); ++b)
    for (int k = 0; k <= scene.degree(); ++k) {
      for (int axis = 0; axis < M::dimension; ++axis) numbers.push_back(motion.coordinate(b, k, axis));
      numbers.push_back(motion.weight(b, k));
      numbers.push_back(motion.radius(b, k));
    }
  if constexpr (lifted<M>)
    for (int axis = 0; axis < M::dimension; ++axis) numbers.push_back(motion.drift(axis));
  return numbers;
}

template <int Dimension = 3>
std::vector<double> step_of(const Scene& scene, std::size_t step) {
  if (scene.is_lifted()) return numbers_in(scene, step, LiftedMotion<Dimension>(scene.bead_count()));
  if (scene.degree() == 1) return numbers_in(scene, step, BezierMotion<Dimension, 1>(scene.bead_count()));
  return numbers_in(scene, step, BezierMotion<Dimension, 3>(scene.bead_count()));
}

TEST(DiscreteStepAdapter, GivesTheSameStepsFromEverySource) {
  const std::vector<Eigen::Matrix3Xd> frames = random_frames(1);
  for (const FrameMotion kind : kinds) {
    const Scene expected = from_memory(frames, kind);
    std::vector<Made> all;
    all.push_back(from_array(frames, kind));
    all.push_back(from_file(frames, kind));
    for (const Made& made : all) {
      ASSERT_EQ(made.scene->step_count(), frame_count - 1);
      EXPECT_EQ(made.scene->known_steps(), frame_count - 1);
      for (const std::size_t step : {0U, 1U, 2U, 3U, 4U, 5U, 2U, 5U, 0U, 4U, 3U, 1U}) {  // also back
        EXPECT_EQ(step_of(*made.scene, step), step_of(expected, step)) << made.name << ", step " << step;
        EXPECT_EQ(made.scene->centers(step), frames[step]);
        EXPECT_EQ(made.scene->frame_number(step), step);
      }
    }
  }
}

TEST(DiscreteStepAdapter, KnowsAPushedHermiteStepOneFrameLater) {
  const std::vector<Eigen::Matrix3Xd> frames = random_frames(2);
  for (const FrameMotion kind : kinds) {
    const Scene expected = from_memory(frames, kind);
    Scene pushed(PushedFrames{3, {static_cast<std::size_t>(beads)}, radii, kind});
    const std::size_t lag = kind == FrameMotion::hermite ? 2 : 1;
    std::size_t loaded = 0;
    for (std::size_t f = 0; f < frame_count; ++f) {
      pushed.push(numbers_of(frames[f]), 0.5 * static_cast<double>(f));
      EXPECT_EQ(pushed.frame_count(), f + 1);
      EXPECT_EQ(pushed.known_steps(), f < lag ? 0 : f + 1 - lag);
      EXPECT_EQ(pushed.centers(f), frames[f]);
      for (; loaded < pushed.known_steps(); ++loaded)
        EXPECT_EQ(step_of(pushed, loaded), step_of(expected, loaded)) << "step " << loaded;
    }
    pushed.end_frames();
    EXPECT_EQ(pushed.known_steps(), frame_count - 1);
    EXPECT_EQ(step_of(pushed, frame_count - 2), step_of(expected, frame_count - 2));
    EXPECT_EQ(pushed.stamp(frame_count - 1).picoseconds, 3.0);
    test::expect_refused([&] { (void)step_of(pushed, 0); },
                         {"frame 0 is gone", "only pushed frames from frame"});
    EXPECT_EQ(step_of(pushed, frame_count - 2), step_of(expected, frame_count - 2));
    EXPECT_THROW(pushed.push(numbers_of(frames[0])), std::logic_error);
  }
}

// A planar scene has the vectors of the cell that lie in its plane, in the plane's coordinates.
TEST(DiscreteStepAdapter, LaysCellsInTheirPlane) {
  const Cell upright = Eigen::Vector3d(10, 20, 30).asDiagonal();
  for (const int across : {0, 1, 2}) {
    Trajectory trajectory;
    for (int frame = 0; frame < 2; ++frame) {
      Eigen::Matrix3Xd& positions = trajectory.frames.emplace_back(Eigen::Matrix3Xd::Random(3, 4));
      positions.row(across).setConstant(2.5);
      trajectory.cells.push_back(upright);
    }
    const Scene scene(std::span(&trajectory, 1), std::vector<double>(4, 1));
    ASSERT_EQ(scene.dimension(), 2);
    ASSERT_TRUE(scene.is_periodic());
    BezierMotion<2, 1> step(4);
    scene.load(0, step);
    ASSERT_NE(step.cell(), nullptr);
    const std::array<int, 2> axes{across == 0 ? 1 : 0, across == 2 ? 1 : 2};
    // The plane may name its axes in either order, so the test compares with the beads.
    const bool turned = step.coordinate(0, 0, 0) != trajectory.frames[0](axes[0], 0);
    for (int axis = 0; axis < 2; ++axis) {
      const int in_input = axes[static_cast<std::size_t>(turned ? 1 - axis : axis)];
      EXPECT_EQ(step.coordinate(0, 0, axis), trajectory.frames[0](in_input, 0));
      double along = 0;
      for (int vector = 0; vector < 2; ++vector) along += std::abs(step.cell()[(vector * 2) * 2 + axis]);
      EXPECT_EQ(along, upright(in_input, in_input));
    }
  }
}

// Beads that are wrapped into a skewed cell, whose tilt jumps by a whole vector, move on as if they were not.
TEST(DiscreteStepAdapter, UnwrapsPushedFrames) {
  Cell cell = Eigen::Vector3d(8, 8, 8).asDiagonal();
  cell(0, 1) = 3.5;
  Cell flipped = cell;
  flipped(0, 1) -= 8;
  Eigen::Matrix3Xd wrapped(3, 2), next(3, 2);
  wrapped << 7, 1, 1, 1, 1, 7;
  next << 0, 1, 0, 1, 0, 7.5;
  Scene scene(PushedFrames{3, {2}, {1}, FrameMotion::linear, cell});
  EXPECT_TRUE(scene.is_periodic());
  scene.push(numbers_of(wrapped));
  next.col(0) = Eigen::Vector3d(9, 1, 1) - cell.col(1);
  scene.push(numbers_of(next), std::nullopt, flipped);
  BezierMotion<3, 1> step(2);
  scene.load(0, step);
  EXPECT_EQ(scene.centers(1).col(0), Eigen::Vector3d(9, 1, 1));
  const Eigen::Vector3d joined = cell.col(0) - cell.col(2);  // the image nearest to bead 0 in the first frame
  EXPECT_EQ(scene.centers(0).col(1), wrapped.col(1) + joined);
  EXPECT_EQ(scene.centers(1).col(1), next.col(1) + joined);
  ASSERT_NE(step.cell(), nullptr);
  for (int vector = 0; vector < 3; ++vector)
    for (int k = 0; k <= 1; ++k)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(step.cell()[(vector * 2 + k) * 3 + axis], cell(axis, vector));
  Cell slab = cell;
  slab.col(2).setZero();
  test::expect_refused([&] { scene.push(numbers_of(next), std::nullopt, slab); },
                       {"frame 2: expected a cell that is periodic along the same vectors as the run's"});
  EXPECT_EQ(scene.frame_count(), 2U);
  test::expect_refused(
      [&] {
        (void)Scene(PushedFrames{2, {2}, {1}, FrameMotion::linear, cell});
      },
      {"a periodic cell in 2 dimensions: expected vectors in the plane"});
}

TEST(DiscreteStepAdapter, LaysFramesOfEverySourceInTheirPlane) {
  std::vector<Eigen::Matrix3Xd> frames = random_frames(3);
  for (Eigen::Matrix3Xd& frame : frames) frame.row(1).setConstant(2.5);
  for (const FrameMotion kind : kinds) {
    const Scene expected = from_memory(frames, kind);
    std::vector<Made> all;
    all.push_back(from_array(frames, kind));
    all.push_back(from_file(frames, kind));
    for (const Made& made : all) {
      ASSERT_EQ(made.scene->dimension(), 2);
      for (const std::size_t step : {0U, 3U, 5U, 1U}) {
        EXPECT_EQ(step_of<2>(*made.scene, step), step_of<2>(expected, step));
        for (Eigen::Index b = 0; b < beads; ++b)
          EXPECT_EQ(made.scene->in_input(made.scene->centers(step).col(b)), frames[step].col(b));
      }
    }
  }
}

TEST(DiscreteStepAdapter, TakesAMotionOfAnyDegree) {
  const Scene linear = from_memory(random_frames(4), FrameMotion::linear);
  EXPECT_EQ(numbers_in(linear, 2, AnyDegreeMotion<3>(linear.bead_count(), 1)), step_of(linear, 2));
  const Scene hermite = from_memory(random_frames(4), FrameMotion::hermite);
  EXPECT_EQ(numbers_in(hermite, 2, AnyDegreeMotion<3>(hermite.bead_count(), 3)), step_of(hermite, 2));
}

TEST(DiscreteStepAdapter, GoesBackOverStraightenedFrames) {
  const std::vector<Eigen::Matrix3Xd> frames = random_frames(5);
  const Scene expected = from_memory(straightened(frames, 6), FrameMotion::linear);
  const Trajectory trajectory = trajectory_of(frames);
  const auto scene = scene_of(
      std::make_unique<StraightenedFrames>(std::make_unique<MemoryFrames>(std::span(&trajectory, 1)), 6),
      FrameMotion::linear);
  EXPECT_NE(scene->centers(1), frames[1]);
  for (const std::size_t step : {0U, 5U, 1U, 4U, 2U})
    EXPECT_EQ(step_of(*scene, step), step_of(expected, step));
}

}  // namespace
}  // namespace kds::discrete_step_adapter_test
