// Updates from frame to frame. For every technique the diagram equals CGAL's static diagram, or, at
// degenerate frames, is regular by the definition.

#include "structures/power_diagram/diagram_update.h"

#include <gmock/gmock.h>

#include <random>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/rounds.h"

namespace kds::diagram_update_test {
namespace {

using namespace test;

struct Frame {
  Eigen::Matrix3Xd centers;
  std::vector<double> weights;
};

constexpr std::array all_techniques{
    UpdateTechnique::rebuild, UpdateTechnique::reinsert, UpdateTechnique::greedy,   UpdateTechnique::kinetic,
    UpdateTechnique::lifted,  UpdateTechnique::activate, UpdateTechnique::automatic};

/// Runs over all frames and checks the diagram at each; returns the sum of the counts.
template <int Dimension>
UpdateCounts run_in(UpdateTechnique technique, const std::vector<Frame>& frames) {
  SCOPED_TRACE(name_of(technique));
  const auto update = make_diagram_update<Dimension>(technique);
  UpdateCounts sum;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "frame " << k);
    if (k == 0) {
      update->build(frames[0].centers, frames[0].weights);
    } else {
      const UpdateCounts counts = update->advance(frames[k].centers, frames[k].weights);
      sum.tested += counts.tested;
      sum.failed += counts.failed;
      sum.activated += counts.activated;
      sum.removed += counts.removed;
      sum.events += counts.events;
      sum.rebuilds += counts.rebuilds;
    }
    const auto expected = static_triangulation<Dimension>(frames[k].centers, frames[k].weights);
    const auto found = update->diagram();
    if (found.cells != expected.cells || found.hidden != expected.hidden) {
      EXPECT_EQ(update->fault().value_or("none"), "none");
    }
  }
  return sum;
}

UpdateCounts run(UpdateTechnique technique, const std::vector<Frame>& frames) {
  return run_in<3>(technique, frames);
}

std::vector<Frame> frames_of(const std::vector<Space>& steps) {
  std::vector<Frame> frames;
  const auto add = [&](const Space& step, int k) {
    frames.push_back({Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(step.bead_count())), {}});
    for (BeadId b = 0; b < step.bead_count(); ++b) {
      for (int axis = 0; axis < 3; ++axis) frames.back().centers(axis, b) = step.coordinate(b, k, axis);
      frames.back().weights.push_back(step.weight(b, k));
    }
  };
  add(steps.front(), 0);
  for (const Space& step : steps) add(step, 1);
  return frames;
}

/// Makes random points in a cube, each of which moves by up to `step` per frame. Weights are between 0 and
/// `weight`, and change if `weights_move`.
std::vector<Frame> random_frames(unsigned seed, Eigen::Index beads, std::size_t count, double step,
                                 double weight, bool weights_move) {
  std::mt19937 random(seed);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<Frame> frames(1);
  frames[0].centers = Eigen::Matrix3Xd::NullaryExpr(3, beads, [&] { return uniform(0, 1); });
  for (Eigen::Index b = 0; b < beads; ++b) frames[0].weights.push_back(uniform(0, weight));
  while (frames.size() < count) {
    frames.push_back(frames.back());
    for (double& x : frames.back().centers.reshaped()) x += uniform(-step, step);
    if (!weights_move) continue;
    for (double& w : frames.back().weights) w = std::max(0.0, w + uniform(-0.1, 0.1) * weight);
  }
  return frames;
}

/// Makes 40 beads at random whole coordinates up to `size`, drawn again in every frame. Weights are 0 for odd
/// seeds, and 0 to 2 for even seeds.
std::vector<Frame> grid_frames(unsigned seed, std::size_t count, int size) {
  std::mt19937 random(seed);
  std::vector<Frame> frames;
  while (frames.size() < count) {
    const Points points = random_grid_points(random, 40, size);
    frames.push_back({control_points(moving(points, points), 0), std::vector<double>(40, 0.0)});
    for (std::size_t b = 0; seed % 2 == 0 && b < 40; ++b)
      frames.back().weights[b] = static_cast<double>(b % 3);
  }
  return frames;
}

TEST(DiagramUpdate, AllTechniquesReachTheStaticDiagram) {
  for (const double step : {0.001, 0.02, 0.3}) {
    for (const UpdateTechnique technique : all_techniques)
      run(technique, random_frames(1, rounds(150U, 60U), 6, step, 0, false));
  }
}

TEST(DiagramUpdate, HiddenBeadsWeightsThatMoveAndBeadsThatComeBack) {
  std::uint64_t hidden = 0;
  for (unsigned seed = 1; seed <= rounds(3U); ++seed) {
    for (const double step : {0.002, 0.05}) {
      const auto frames = random_frames(seed, 80, 6, step, 0.08, seed != 1);
      for (const Frame& f : frames) hidden += static_triangulation<3>(f.centers, f.weights).hidden.size();
      for (const UpdateTechnique technique : all_techniques) run(technique, frames);
    }
  }
  EXPECT_GT(hidden, rounds(100U));
}

TEST(DiagramUpdate, TrajectoriesAndTheirStrides) {
  for (const std::size_t stride : {1U, 20U}) {
    const auto frames = frames_of(trajectory_steps("villin_hp36_300K.dcd", 0, 4 * stride, stride));
    for (const UpdateTechnique technique : all_techniques) run(technique, frames);
  }
}

// Whole coordinates: many cospherical beads, flat hulls, coincident beads.
TEST(DiagramUpdate, DegenerateFrames) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const auto frames = grid_frames(seed, 4, seed < 3 ? 5 : 4);
    for (const UpdateTechnique technique : all_techniques) run(technique, frames);
  }
}

TEST(DiagramUpdate, NothingHappensWhereNothingMoves) {
  auto frames = random_frames(7, 100, 1, 0, 0.05, false);
  frames.resize(3, frames[0]);
  for (const UpdateTechnique technique : all_techniques) {
    const UpdateCounts counts = run(technique, frames);
    EXPECT_EQ(counts.failed, 0U);
    EXPECT_EQ(counts.events, 0U);
    EXPECT_EQ(counts.removed, 0U);
    EXPECT_EQ(counts.rebuilds, technique == UpdateTechnique::rebuild ? 2U : 0U);
  }
}

TEST(DiagramUpdate, OneBeadMovesAlone) {
  auto frames = random_frames(8, 200, 1, 0, 0, false);
  frames.resize(2, frames[0]);
  // Bead 50 moves into the middle of the other beads.
  frames[1].centers.col(50) += Eigen::Vector3d(0.08, 0.03, -0.02);
  const UpdateCounts activate = run(UpdateTechnique::activate, frames);
  EXPECT_GT(activate.failed, 0U);
  EXPECT_GT(activate.activated, 0U);
  EXPECT_LT(activate.activated, 60U);
  EXPECT_GT(activate.events, 0U);
  EXPECT_EQ(activate.rebuilds, 0U);
  const UpdateCounts kinetic = run(UpdateTechnique::kinetic, frames);
  EXPECT_EQ(kinetic.activated, 200U);
  EXPECT_LE(kinetic.events, activate.events);
  // All failed certificates contain bead 50.
  const UpdateCounts greedy = run(UpdateTechnique::greedy, frames);
  EXPECT_EQ(greedy.removed, 1U);
  EXPECT_EQ(greedy.rebuilds, 0U);
  const UpdateCounts reinsert = run(UpdateTechnique::reinsert, frames);
  EXPECT_GE(reinsert.removed, greedy.removed);
}

TEST(DiagramUpdate, TooManyToTakeOutIsARebuildAndSaysSo) {
  const auto frames = random_frames(9, 150, 2, 0.5, 0, false);
  for (const UpdateTechnique technique : {UpdateTechnique::reinsert, UpdateTechnique::greedy}) {
    const UpdateCounts counts = run(technique, frames);
    EXPECT_EQ(counts.rebuilds, 1U);
    EXPECT_GT(counts.removed, 15U);
  }
}

TEST(DiagramUpdate, AutomaticMovesWhereLittleHappensAndRebuildsWhereMuchDoes) {
  EXPECT_EQ(run(UpdateTechnique::automatic, random_frames(3, 300, 4, 0.001, 0, false)).rebuilds, 0U);
  EXPECT_EQ(run(UpdateTechnique::automatic, random_frames(3, 300, 4, 0.5, 0, false)).rebuilds, 3U);
}

// If one technique clearly wins, samples become rare. A change is noticed when the step is given up, and is
// sampled again some frames later.
TEST(DiagramUpdate, AutomaticSamplesSeldomWhereTheAnswerIsClear) {
  auto frames = random_frames(3, 300, 21, 0.001, 0, false);
  const std::size_t slow = frames.size() - 1;
  for (Frame& frame : random_frames(5, 300, 12, 0.5, 0, false)) frames.push_back(std::move(frame));
  const auto update = make_diagram_update<3>(UpdateTechnique::automatic);
  update->build(frames[0].centers, frames[0].weights);
  std::vector<std::size_t> sampled;
  std::uint64_t rebuilds = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const UpdateCounts counts = update->advance(frames[k].centers, frames[k].weights);
    if (counts.tested > 0) sampled.push_back(k);
    rebuilds += counts.rebuilds;
    EXPECT_TRUE(k > slow || counts.rebuilds == 0);
  }
  ASSERT_GE(sampled.size(), 5U);
  EXPECT_EQ(std::vector<std::size_t>(sampled.begin(), sampled.begin() + 5),
            (std::vector<std::size_t>{1, 3, 7, 15, 29}));
  EXPECT_EQ(rebuilds, 12U);
}

TEST(DiagramUpdate, AutomaticGivesUpWhereMuchHappensThatTheFramesDoNotShow) {
  // One crowd passes through another, to and fro. Each crowd stays as it is, except where it faces the other.
  constexpr unsigned beads = rounds(400U, 120U);
  auto frames = random_frames(5, beads, 1, 0, 0, false);
  frames.resize(8, frames[0]);
  for (std::size_t k = 0; k < frames.size(); ++k)
    frames[k].centers.leftCols(beads / 2).row(0).array() += k % 2 == 0 ? -1.5 : 1.5;
  const UpdateCounts moved = run(UpdateTechnique::kinetic, frames);
  EXPECT_GT(moved.events, 7 * 3 * beads);
  const UpdateCounts counts = run(UpdateTechnique::automatic, frames);
  EXPECT_EQ(counts.rebuilds, 7U);
  EXPECT_EQ(counts.activated, beads);  // one step was tried
  EXPECT_LE(counts.events, 3 * beads);
}

TEST(DiagramUpdate, FramesInOnePlaneOnTheWay) {
  auto frames = random_frames(4, 30, 3, 0.1, 0, false);
  frames[1].centers.row(2).setConstant(0.5);
  for (const UpdateTechnique technique :
       {UpdateTechnique::rebuild, UpdateTechnique::reinsert, UpdateTechnique::kinetic,
        UpdateTechnique::lifted, UpdateTechnique::activate, UpdateTechnique::automatic})
    run(technique, frames);
}

// A straight chain rolls up. Some beads are hidden by other beads while the diagram has no cells yet.
TEST(DiagramUpdate, HiddenBeadsInAFlatFrame) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    auto frames = random_frames(seed, 4 + 2 * seed, 4, 0.2, 0.3, false);
    const auto last = static_cast<Eigen::Index>(frames[0].weights.size() - 1);
    frames[0].centers.bottomRows(seed % 2 == 0 ? 1 : 2).setZero();
    frames[0].centers.col(1) = frames[0].centers.col(0);
    frames[0].centers.col(last) = frames[0].centers.col(0);
    for (const UpdateTechnique technique : all_techniques) run(technique, frames);
  }
}

TEST(DiagramUpdateInPlane, AllTechniquesReachTheStaticDiagram) {
  for (const double step : {0.001, 0.02, 0.3}) {
    for (const UpdateTechnique technique : all_techniques)
      run_in<2>(technique, random_frames(1, 150, 6, step, 0, false));
  }
}

TEST(DiagramUpdateInPlane, HiddenBeadsWeightsThatMoveAndBeadsThatComeBack) {
  std::uint64_t hidden = 0, removed = 0, rebuilds = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    for (const double step : {0.0005, 0.002, 0.05}) {
      const auto frames = random_frames(seed, 120, 8, step, 0.02, seed != 1);
      for (const Frame& f : frames) hidden += static_triangulation<2>(f.centers, f.weights).hidden.size();
      for (const UpdateTechnique technique : all_techniques) {
        const UpdateCounts counts = run_in<2>(technique, frames);
        if (technique == UpdateTechnique::greedy) {
          removed += counts.removed;
          rebuilds += counts.rebuilds;
        }
      }
    }
  }
  EXPECT_GT(hidden, 500U);
  // Many steps removed and inserted beads; only some had too many such beads and rebuilt the diagram.
  EXPECT_GT(removed, 100U);
  EXPECT_LT(rebuilds, 60U);
}

// Many beads on one circle, flat hulls, coincident beads, and in one frame all beads on one line.
TEST(DiagramUpdateInPlane, DegenerateFrames) {
  for (unsigned seed = 1; seed <= rounds(6U, 3U); ++seed) {
    auto frames = grid_frames(seed, 5, seed < 4 ? 8 : 5);
    for (Frame& frame : frames) frame.centers.row(2).setZero();
    if (seed == 3) frames[2].centers.row(1).setConstant(1);
    for (const UpdateTechnique technique : all_techniques) run_in<2>(technique, frames);
  }
}

TEST(DiagramUpdate, TooFewBeads) {
  const Eigen::Matrix3Xd three = Eigen::Matrix3Xd::Identity(3, 3);
  for (const UpdateTechnique technique : all_techniques)
    EXPECT_THROW(make_diagram_update<3>(technique)->build(three, std::vector<double>(3)), InputError);
  for (const UpdateTechnique technique : all_techniques)
    EXPECT_THROW(make_diagram_update<2>(technique)->build(three.leftCols(2), std::vector<double>(2)),
                 InputError);
}

}  // namespace
}  // namespace kds::diagram_update_test
