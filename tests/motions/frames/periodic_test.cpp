#include "motions/frames/periodic.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <limits>
#include <random>

namespace kds::periodic_test {
namespace {

using Frames = std::vector<Eigen::Matrix3Xd>;
using Cells = std::vector<std::optional<Cell>>;

// Returns in how many frames something moved. A cell that is not given is none.
std::size_t make_whole(Frames& frames, const Cells& cells) {
  WholeChain chain;
  std::size_t moved = 0;
  for (std::size_t k = 0; k < frames.size(); ++k)
    if (chain.make_whole(frames[k], k < cells.size() ? cells[k] : std::nullopt)) ++moved;
  return moved;
}

// A random walk with short bonds that drifts from frame to frame.
Frames walk(std::mt19937& random, Eigen::Index beads, std::size_t count, const Eigen::Vector3d& drift) {
  std::uniform_real_distribution<double> step(-1, 1);
  Eigen::Matrix3Xd chain = Eigen::Matrix3Xd::Zero(3, beads);
  for (Eigen::Index i = 1; i < beads; ++i)
    chain.col(i) = chain.col(i - 1) + Eigen::Vector3d(step(random), step(random), step(random));
  Frames frames;
  for (std::size_t k = 0; k < count; ++k) frames.push_back(chain.colwise() + static_cast<double>(k) * drift);
  return frames;
}

// Puts every bead into the cell, as simulation programs do.
Frames wrapped(const Frames& frames, const Cell& cell) {
  Frames result = frames;
  const Cell inverse = cell.inverse();
  for (Eigen::Matrix3Xd& frame : result)
    for (Eigen::Index i = 0; i < frame.cols(); ++i)
      frame.col(i) -= cell * (inverse * frame.col(i)).array().floor().matrix();
  return result;
}

void expect_same_shape(const Frames& whole, const Frames& expected) {
  const Eigen::Vector3d shift = expected[0].col(0) - whole[0].col(0);
  for (std::size_t k = 0; k < whole.size(); ++k)
    EXPECT_LT(((whole[k].colwise() + shift) - expected[k]).cwiseAbs().maxCoeff(), 1e-9) << k;
}

TEST(Periodic, UprightCell) {
  std::mt19937 random(1);
  const Cell cell = *cell_from_lengths({10, 12, 9}, {0, 0, 0});
  const Frames truth = walk(random, 60, 30, {1.3, -0.7, 2.1});
  Frames frames = wrapped(truth, cell);
  EXPECT_GT(make_whole(frames, Cells(frames.size(), cell)), 0U);
  expect_same_shape(frames, truth);
}

TEST(Periodic, SkewCell) {
  std::mt19937 random(2);
  const Cell cell = *cell_from_angles({12, 11, 13}, {60, 70, 60});
  const Frames truth = walk(random, 60, 30, {1.3, -0.7, 2.1});
  Frames frames = wrapped(truth, cell);
  make_whole(frames, Cells(frames.size(), cell));
  expect_same_shape(frames, truth);
}

TEST(Periodic, WholeFramesKeepTheirBits) {
  std::mt19937 random(3);
  const Frames truth = walk(random, 20, 5, {0.1, 0.1, 0.1});
  Frames frames = truth;
  EXPECT_EQ(make_whole(frames, Cells(5, cell_from_lengths({1000, 1000, 1000}, {0, 0, 0}))), 0U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(frames[k], truth[k]);
}

TEST(Periodic, WithoutCellNothingMoves) {
  std::mt19937 random(4);
  const Frames truth = walk(random, 20, 3, {100, 0, 0});
  Frames frames = truth;
  EXPECT_EQ(make_whole(frames, Cells(3)), 0U);
  EXPECT_EQ(make_whole(frames, {}), 0U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(frames[k], truth[k]);
}

TEST(Periodic, HalfwayStaysWhereItIs) {
  Frames frames(1, Eigen::Matrix3Xd::Zero(3, 2));
  frames[0](0, 1) = 5;
  EXPECT_EQ(make_whole(frames, Cells(1, cell_from_lengths({10, 10, 10}, {0, 0, 0}))), 0U);
}

TEST(Periodic, FarOutCoordinatesStayFinite) {
  Frames frames(2, Eigen::Matrix3Xd::Zero(3, 2));
  frames[0](0, 1) = 1e300;
  frames[1](1, 0) = -1e308;
  frames[1](1, 1) = 1e308;
  make_whole(frames, Cells(2, cell_from_lengths({10, 10, 10}, {0, 0, 0})));
  EXPECT_TRUE(frames[0].allFinite());
  EXPECT_TRUE(frames[1].allFinite());
}

TEST(Periodic, CellsThatAreNone) {
  EXPECT_FALSE(cell_from_lengths({1, 1, 1}, {0, 0, 0}).has_value());
  EXPECT_FALSE(cell_from_lengths({0, 20, 20}, {0, 0, 0}).has_value());
  EXPECT_FALSE(cell_from_lengths({-9, 20, 20}, {0, 0, 0}).has_value());
  EXPECT_FALSE(cell_from_lengths({20, 20, 20}, {1, 1, 1}).has_value());
  EXPECT_FALSE(cell_from_lengths({20, 20, 20}, {3, 0, 0}).has_value());
  EXPECT_FALSE(cell_from_lengths({20, 20, std::numeric_limits<double>::quiet_NaN()}, {0, 0, 0}).has_value());
  EXPECT_FALSE(cell_from_lengths({20, 20, std::numeric_limits<double>::infinity()}, {0, 0, 0}).has_value());
  EXPECT_FALSE(cell_from_angles({20, 20, 20}, {30, 30, 90}).has_value());
}

TEST(Periodic, CellOfATruncatedOctahedron) {
  const Cell cell = *cell_from_angles({20, 20, 20}, {109.4712206, 109.4712206, 109.4712206});
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(cell.col(i).norm(), 20, 1e-9);
  EXPECT_NEAR(cell.col(0).dot(cell.col(1)), -400.0 / 3, 1e-4);
  EXPECT_NEAR(cell.col(1).dot(cell.col(2)), -400.0 / 3, 1e-4);
}

}  // namespace
}  // namespace kds::periodic_test
