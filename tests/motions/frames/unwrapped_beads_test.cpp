// Beads that move through the walls of a periodic cell.

#include <gtest/gtest.h>

#include "motions/frames/periodic.h"
#include "tests/support/inputs/random.h"

namespace kds::unwrapped_beads_test {
namespace {

using namespace test;

Cell random_cell(Random& random) {
  Cell cell = Eigen::Vector3d(16, 24, 20).asDiagonal();
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < i; ++j) cell(j, i) = pick(random, -8, 8);
  return cell;
}

/// Moves a point into the cell, in whole vectors.
Eigen::Vector3d wrapped(const Eigen::Vector3d& point, const Cell& cell) {
  const Eigen::Vector3d share = cell.triangularView<Eigen::Upper>().solve(point);
  return point - cell * share.array().floor().matrix();
}

// Paths of small steps in dyadic numbers come back exactly, however often they are wrapped.
TEST(UnwrappedBeads, FollowWrappedPaths) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const Cell cell = random_cell(random);
    Eigen::Matrix3Xd path(3, 5);
    for (double& x : path.reshaped()) x = pick(random, 0, 12);
    Eigen::Matrix3Xd offset;
    UnwrappedBeads beads;
    for (int frame = 0; frame < 60; ++frame) {
      for (double& x : path.reshaped()) x += 0.25 * pick(random, -7, 9);
      Eigen::Matrix3Xd now = path;
      for (Eigen::Index b = 0; b < now.cols(); ++b) now.col(b) = wrapped(path.col(b), cell);
      if (frame == 0) offset = path - now;
      beads.follow(now, cell);
      EXPECT_EQ(now + offset, path) << "frame " << frame;
    }
  }
}

// A bead far from the cell moves with the vectors that it has passed, not back to the nearest image.
TEST(UnwrappedBeads, FollowACellThatChanges) {
  UnwrappedBeads beads;
  Eigen::Matrix3Xd frame(3, 1);
  double wrapped_x = 0, length = 16;
  for (int step = 0; step <= 400; ++step) {
    Cell cell = Eigen::Vector3d(length, 16, 16).asDiagonal();
    frame.col(0) = Eigen::Vector3d(wrapped_x, 0, 0);
    beads.follow(frame, cell);
    EXPECT_EQ(frame(0, 0), step / 4 * length + step % 4 * 4) << "step " << step;
    wrapped_x = (step + 1) % 4 * 4;
    if (step % 4 == 3) length = length == 16 ? 17 : 16;
  }
}

TEST(UnwrappedBeads, StartAgain) {
  const Cell cell = Eigen::Vector3d(16, 16, 16).asDiagonal();
  UnwrappedBeads beads;
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Constant(3, 1, 15);
  beads.follow(frame, cell);
  frame.setConstant(1);
  beads.follow(frame, cell);
  EXPECT_EQ(frame(0, 0), 17);
  beads.restart();
  frame.setConstant(1);
  beads.follow(frame, cell);
  EXPECT_EQ(frame(0, 0), 1);
}

// A triclinic cell whose tilt jumps by a whole vector spans the same lattice.
TEST(UnwrappedBeads, TiltsDoNotJump) {
  Cell before = Eigen::Vector3d(8, 12, 16).asDiagonal(), after = before;
  before(0, 1) = 4;
  after(0, 1) = -4;
  EXPECT_EQ(continued(after, before), before);
  after(1, 2) = 11.5;
  EXPECT_LT((continued(after, before) - before).cwiseAbs().maxCoeff(), 4.5);
  EXPECT_EQ(continued(before, before), before);
  EXPECT_EQ(continued(1.3 * before, before), 1.3 * before);
  before.col(2).setZero();
  EXPECT_EQ(continued(before, before), before);
}

TEST(SequenceInCell, ChainsAndFluids) {
  Random random(2);
  const Cell cell = random_cell(random);
  Eigen::Matrix3Xd fluid(3, 200), chain(3, 200), molecules(3, 200);
  for (double& x : fluid.reshaped()) x = 20 * (1 + uniform(random));
  for (Eigen::Index b = 0; b < chain.cols(); ++b) {
    fluid.col(b) = wrapped(fluid.col(b), cell);
    chain.col(b) = Eigen::Vector3d(3.8 * static_cast<double>(b), uniform(random), 0);
    chain.col(b) = wrapped(chain.col(b), cell);
  }
  for (Eigen::Index b = 0; b < chain.cols(); ++b)
    molecules.col(b) = fluid.col(b / 4 * 4) + static_cast<double>(b % 4) * Eigen::Vector3d::UnitZ();
  EXPECT_EQ(sequence_in_cell(fluid, cell), SequenceInCell::fluid);
  EXPECT_EQ(sequence_in_cell(chain, cell), SequenceInCell::chain);
  EXPECT_EQ(sequence_in_cell(molecules, cell), SequenceInCell::several_chains);
}

}  // namespace
}  // namespace kds::unwrapped_beads_test
