#include "motions/frames/periodic.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <limits>
#include <random>

#include "tests/support/inputs/cells.h"
#include "tests/support/rounds.h"

namespace kds::periodic_test {
namespace {

using Frames = std::vector<Eigen::Matrix3Xd>;
using Cells = std::vector<std::optional<Cell>>;

// Returns the number of frames in which a bead moved. Frames beyond the end of `cells` have no cell.
std::size_t make_whole(Frames& frames, const Cells& cells) {
  WholeChain chain;
  std::size_t moved = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto outcome = chain.make_whole(frames[k], k < cells.size() ? cells[k] : std::nullopt);
    if (outcome == WholeChain::Outcome::joined || outcome == WholeChain::Outcome::shifted) ++moved;
  }
  return moved;
}

// Makes a random walk with short bonds that drifts from frame to frame.
Frames walk(std::mt19937& random, Eigen::Index beads, std::size_t count, const Eigen::Vector3d& drift) {
  std::uniform_real_distribution<double> step(-1, 1);
  Eigen::Matrix3Xd chain = Eigen::Matrix3Xd::Zero(3, beads);
  for (Eigen::Index i = 1; i < beads; ++i)
    chain.col(i) = chain.col(i - 1) + Eigen::Vector3d(step(random), step(random), step(random));
  Frames frames;
  for (std::size_t k = 0; k < count; ++k) frames.push_back(chain.colwise() + static_cast<double>(k) * drift);
  return frames;
}

// Wraps every bead into the cell, as simulation programs do.
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

TEST(Periodic, CellsOfAnyShapeMakeChainsWhole) {
  std::mt19937 random(1);
  std::vector<Cell> cells{*test::cell_from_lengths({10, 12, 9}, {0, 0, 0}),
                          *test::cell_from_angles({12, 11, 13}, {60, 70, 60})};
  for (const double lean : {45.0, 95.0, 1005.0, -3330.0})
    (cells.emplace_back() << 10, lean, -2 * lean, 0, 12, lean, 0, 0, 9).finished();
  for (const Cell& cell : cells) {
    const Frames truth = walk(random, 60, 30, {1.3, -0.7, 2.1});
    Frames frames = wrapped(truth, cell);
    EXPECT_GT(make_whole(frames, Cells(frames.size(), read_cell(cell).cell)), 0U);
    expect_same_shape(frames, truth);
  }
}

TEST(Periodic, WholeFramesKeepTheirBits) {
  std::mt19937 random(3);
  const Frames truth = walk(random, 20, 5, {0.1, 0.1, 0.1});
  Frames frames = truth;
  EXPECT_EQ(make_whole(frames, Cells(5, test::cell_from_lengths({1000, 1000, 1000}, {0, 0, 0}))), 0U);
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
  EXPECT_EQ(make_whole(frames, Cells(1, test::cell_from_lengths({10, 10, 10}, {0, 0, 0}))), 0U);
}

TEST(Periodic, FarOutCoordinatesStayFinite) {
  Frames frames(2, Eigen::Matrix3Xd::Zero(3, 2));
  frames[0](0, 1) = 1e300;
  frames[1](1, 0) = -1e308;
  frames[1](1, 1) = 1e308;
  make_whole(frames, Cells(2, test::cell_from_lengths({10, 10, 10}, {0, 0, 0})));
  EXPECT_TRUE(frames[0].allFinite());
  EXPECT_TRUE(frames[1].allFinite());
}

// Finds the shortest image by brute force over all images within reach.
double shortest_image(const Eigen::Vector3d& difference, const Cell& cell, int reach) {
  double shortest = difference.norm();
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k)
        shortest = std::min(shortest, (difference + cell * Eigen::Vector3d(i, j, k)).norm());
  return shortest;
}

TEST(Periodic, NearestImagesInCellsOfAnyShape) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-60, 60);
  std::uniform_int_distribution<int> multiple(-4, 4);
  for (int round = 0; round < test::rounds(40); ++round) {
    const Cell small =
        *test::cell_from_angles({12.0 + round % 3, 11, 13.0 + round % 5}, {60.0 + round, 70, 75});
    // These vectors span the same lattice, and may be arbitrarily oblique.
    Cell steps = Cell::Identity();
    steps(0, 1) = multiple(random);
    steps(0, 2) = multiple(random);
    steps(1, 2) = multiple(random);
    const Cell skew = *read_cell(small * steps).cell;
    const Images images(skew);
    for (int point = 0; point < 20; ++point) {
      const Eigen::Vector3d difference(place(random), place(random), place(random));
      const Eigen::Vector3d shift = images.nearest(difference);
      EXPECT_EQ(shift, shift.array().round().matrix());
      EXPECT_NEAR((difference + skew * shift).norm(), shortest_image(difference, small, 9), 1e-9) << round;
    }
  }
}

// The search for the nearest image ends, whatever the shape of a cell in use.
TEST(Periodic, NearestImagesInExtremeCells) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> magnitude(0, 7.7), place(-1, 1);
  int used = 0;
  for (int round = 0; round < test::rounds(20'000); ++round) {
    Cell cell;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        cell(axis, i) = random() % 3 == 0 ? 0 : place(random) * std::pow(10, magnitude(random));
    const CellRead read = read_cell(cell);
    if (!read.cell) continue;
    ++used;
    const Images images(cell);
    Eigen::Vector3d difference(place(random), place(random), place(random));
    difference *= std::pow(10, magnitude(random));
    const Eigen::Vector3d shift = images.nearest(difference);
    EXPECT_EQ(shift, shift.array().round().matrix());
    EXPECT_LE((difference + cell * shift).norm(), difference.norm() * (1 + 1e-9));
  }
  EXPECT_GT(used, test::rounds(1000));
}

TEST(Periodic, OnlyPeriodicAxesMove) {
  std::mt19937 random(7);
  const Frames truth = walk(random, 60, 5, {0.4, 0.3, 0.2});
  Cell vectors;
  vectors << 10, 3, 0, 0, 11, 0, 0, 0, 9;
  for (int open = 0; open < 8; ++open) {
    const std::array<bool, 3> periodic{(open & 1) == 0, (open & 2) == 0, (open & 4) == 0};
    const CellRead read = read_cell(vectors, periodic);
    EXPECT_EQ(read.doubt, "");
    EXPECT_EQ(read.cell.has_value(), open != 7);
    if (!read.cell) continue;
    Frames frames = truth;
    const Cell inverse = vectors.inverse();
    for (Eigen::Matrix3Xd& frame : frames)
      for (Eigen::Index i = 0; i < frame.cols(); ++i)
        frame.col(i) -= *read.cell * (inverse * frame.col(i)).array().floor().matrix();
    make_whole(frames, Cells(frames.size(), read.cell));
    expect_same_shape(frames, truth);
  }
}

TEST(Periodic, CellsThatAreNotUsedSayWhy) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto doubt = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                        const std::array<bool, 3>& periodic = {true, true, true}) {
    Cell cell;
    cell << a, b, c;
    const CellRead read = read_cell(cell, periodic);
    EXPECT_FALSE(read.cell.has_value() && !read.doubt.empty());
    return read.doubt;
  };
  // These values mean that there is no cell, so no doubt is reported.
  EXPECT_EQ(doubt({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), "");
  EXPECT_EQ(doubt({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), "");
  EXPECT_EQ(doubt({nan, 0, 0}, {0, 0, 0}, {0, 0, 0}, {false, false, false}), "");
  EXPECT_EQ(doubt({20, 0, 0}, {0, 20, 0}, {0, 0, 0}, {true, true, false}), "");
  for (const double bad : {0.0, nan, infinity, 0.5})
    EXPECT_NE(doubt({20, 0, 0}, {0, 20, 0}, {0, 0, bad}), "") << bad;
  EXPECT_NE(doubt({20, 0, 0}, {40, 0, 0}, {0, 0, 20}), "");    // vectors along one line
  EXPECT_NE(doubt({20, 0, 0}, {0, 20, 0}, {7, 11, 0}), "");    // vectors in one plane
  EXPECT_NE(doubt({20, 0, 0}, {20.5, 0, 0}, {0, 0, 20}), "");  // a vector is shorter than 1 after reduction
  EXPECT_NE(doubt({20, 0, 0}, {20, 0.5, 0}, {0, 0, 20}), "");  // a vector is shorter than 1 after reduction
  EXPECT_NE(doubt({1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}), "");  // the squares overflow
  EXPECT_NE(doubt({-5e24, 0, 3e37}, {1.6e36, 1920, 0}, {20, 0, 40}),
            "");  // steps to the image would be endless
  EXPECT_NE(read_cell_from_lengths({20, 20, 1e30}, {0, 0, 0}).doubt, "");
  EXPECT_NE(read_cell_from_lengths({-9, 20, 20}, {0, 0, 0}).doubt, "");
  EXPECT_NE(read_cell_from_lengths({20, 20, nan}, {0, 0, 0}).doubt, "");
  EXPECT_NE(read_cell_from_angles({20, 20, 20}, {30, 30, 90}).doubt, "");
  EXPECT_EQ(read_cell_from_angles({0, 0, 0}, {0, 0, 0}).doubt, "");
  for (const double cosine : {1.0, 3.0})
    EXPECT_FALSE(test::cell_from_lengths({20, 20, 20}, {cosine, 1, 1}).has_value());
}

// Whole chains with a wrong cell: joining by that cell would shorten bonds, but not make them more alike.
TEST(Periodic, BondsThatWouldNotBeMoreAlikeStay) {
  for (const double bond : {5.5, 6.0, 7.5, 9.0, 9.9}) {
    Eigen::Matrix3Xd chain = Eigen::Matrix3Xd::Zero(3, 12);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> turn(-1, 1);
    for (Eigen::Index i = 1; i < chain.cols(); ++i)
      chain.col(i) = chain.col(i - 1) + bond * Eigen::Vector3d(1, turn(random), turn(random)).normalized() *
                                            (1 + 0.01 * turn(random));
    Eigen::Matrix3Xd straight = Eigen::Matrix3Xd::Zero(3, 12);
    for (Eigen::Index i = 1; i < straight.cols(); ++i) straight(0, i) = straight(0, i - 1) + bond;
    for (const Eigen::Matrix3Xd& truth : {chain, straight}) {
      Eigen::Matrix3Xd frame = truth;
      EXPECT_EQ(WholeChain().make_whole(frame, test::cell_from_lengths({10, 10, 10}, {0, 0, 0})),
                WholeChain::Outcome::doubtful)
          << bond;
      EXPECT_EQ(frame, truth);
    }
  }
}

TEST(Periodic, ChainsThatAreMovedAsAWhole) {
  const Cell cell = *test::cell_from_lengths({10, 10, 10}, {0, 0, 0});
  Eigen::Matrix3Xd chain(3, 3);
  chain << 0, 1.5, 3, 0, 0, 0, 0, 0, 0;
  WholeChain whole;
  Eigen::Matrix3Xd frame = chain;
  EXPECT_EQ(whole.make_whole(frame, cell), WholeChain::Outcome::unmoved);
  frame = chain.array() + 8;
  EXPECT_EQ(whole.make_whole(frame, cell), WholeChain::Outcome::shifted);
  EXPECT_LT((frame - (chain.array() - 2).matrix()).norm(), 1e-9);
  frame(0, 0) += 10;
  EXPECT_EQ(whole.make_whole(frame, cell), WholeChain::Outcome::joined);
}

// A chain that was wrapped into a cell of any shape is never longer than the cell; a longer chain was never
// wrapped.
TEST(Periodic, ChainsLongerThanTheirCell) {
  std::mt19937 random(9);
  for (const Eigen::Vector3d& angles : {Eigen::Vector3d(90, 90, 90), Eigen::Vector3d(60, 70, 60),
                                        Eigen::Vector3d(109.4712206, 109.4712206, 109.4712206)}) {
    const Cell cell = *test::cell_from_angles({12, 11, 13}, angles);
    Cell leaning = cell;
    leaning.col(1) += 3 * cell.col(0);
    for (const Cell& of_lattice : {cell, leaning}) {
      for (int round = 0; round < 50; ++round) {
        for (const Eigen::Matrix3Xd& frame : wrapped(walk(random, 40, 3, {1.3, -0.7, 2.1}), of_lattice))
          EXPECT_FALSE(longer_than_cell(frame, of_lattice));
      }
    }
    Eigen::Matrix3Xd straight = Eigen::Matrix3Xd::Zero(3, 60);
    for (Eigen::Index i = 0; i < straight.cols(); ++i) straight.col(i) = 0.3 * i * Eigen::Vector3d(1, 2, 3);
    const auto longer = longer_than_cell(straight, cell);
    ASSERT_TRUE(longer);
    EXPECT_GT(longer->chain, longer->cell);
    straight.rightCols(30).colwise() += cell.col(0);  // one bond crosses the wall
    EXPECT_FALSE(longer_than_cell(straight, cell));
  }
}

TEST(Periodic, AnglesOfACell) {
  for (const double angle : {0.0, 180.0, 270.0, -90.0, 450.0, std::numeric_limits<double>::quiet_NaN()})
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d angles(90, 90, 90);
      angles[axis] = angle;
      EXPECT_NE(read_cell_from_angles({20, 20, 20}, angles).doubt, "") << angle;
    }
}

TEST(Periodic, CellOfATruncatedOctahedron) {
  const Cell cell = *test::cell_from_angles({20, 20, 20}, {109.4712206, 109.4712206, 109.4712206});
  for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(cell.col(i).norm(), 20, 1e-9);
  EXPECT_NEAR(cell.col(0).dot(cell.col(1)), -400.0 / 3, 1e-4);
  EXPECT_NEAR(cell.col(1).dot(cell.col(2)), -400.0 / 3, 1e-4);
}

}  // namespace
}  // namespace kds::periodic_test
