// Bounds how much larger layered cages are than wrapped cages: Theorem 2.3 and Lemmas 2.4 and 2.5 of Agarwal
// et al.

#include <gtest/gtest.h>

#include <cmath>

#include "structures/hierarchy/layered_hierarchy.h"
#include "tests/support/inputs/ball_sets.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/rounds.h"

namespace kds::tightness_test {
namespace {

using namespace test;

constexpr double slack = 1e-12;  // relative to the squared radius: both hierarchies round

/// Returns the level of each node: the greatest number of edges down to a bead.
std::vector<int> levels_of(const NecklaceTree& tree) {
  std::vector<int> level(tree.node_count());
  const auto of = [&](NodeId child) { return child == NecklaceTree::leaf ? 0 : level[child]; };
  for (NodeId node = static_cast<NodeId>(level.size()); node-- > 0;)
    level[node] = 1 + std::max(of(tree.left(node)), of(tree.right(node)));
  return level;
}

template <int D>
void check_bounds(const Eigen::Matrix3Xd& centers, const std::vector<double>& radii) {
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(radii.size() - 1)}};
  StaticWrappedHierarchy<D> wrapped(necklace);
  LayeredHierarchy<D> layered(necklace);
  const Balls<D> balls(centers, radii);
  wrapped.build(balls);
  layered.build(balls);
  const NecklaceTree& tree = wrapped.tree();
  const std::vector<int> level = levels_of(tree);
  // Every subtree is a hierarchy, so each root is compared with all nodes below it.
  for (NodeId root = 0; root < tree.node_count(); ++root) {
    const Sphere whole = wrapped.sphere(root);
    if (whole.radius == 0) continue;  // all beads coincide
    const double square = whole.radius * whole.radius;
    const double ratio = layered.sphere(root).radius / whole.radius;
    ASSERT_GE(ratio, 1 - slack);
    ASSERT_LE(ratio, std::sqrt(level[root] + 1) * (1 + slack));
    const auto end = root + tree.range(root).last - tree.range(root).first;
    for (NodeId node = root; node < end; ++node) {
      const Sphere cage = layered.sphere(node);
      const double distance = (cage.center - whole.center).template head<D>().squaredNorm();
      ASSERT_LE(cage.radius * cage.radius, (level[node] + 1) * (square - distance) + slack * square)
          << "beads " << tree.range(node).first << "-" << tree.range(node).last;
    }
    for (BeadId b = tree.range(root).first; b <= tree.range(root).last; ++b) {
      const double distance = (centers.col(b) - whole.center).template head<D>().squaredNorm();
      ASSERT_LE(radii[b] * radii[b], square - distance + slack * square) << "bead " << b;
    }
  }
  const Tightness ratios = tightness_of(wrapped, layered);
  EXPECT_LE(ratios.average, 1 + slack);
  EXPECT_LE(ratios.least, ratios.average);
  EXPECT_GE(ratios.least, 1 / std::sqrt(level[0] + 1) * (1 - slack));
}

TEST(Tightness, BoundsHoldLevelByLevelOnRandomBalls) {
  std::mt19937 random(61);
  for (int round = 0; round < test::rounds(40); ++round) {
    for (const std::size_t which : {0, 1, 3, 4}) {
      const BallSet set = hard_ball_set(random, which, 2 + round * 4, round % 2 == 0, round % 3 == 0);
      check_bounds<3>(set.centers, set.radii);
      if (round % 3 == 0) check_bounds<2>(set.centers, set.radii);
    }
  }
}

TEST(Tightness, BoundsHoldOnProteinsAndTrajectories) {
  for (const std::string name : {"proteins/1l2y.pdb", "proteins/6wqa.cif", "trajectories/random100_400K.pdb",
                                 "trajectories/dhodh363_1000K.pdb"}) {
    const Trajectory trajectory = read_trajectory(data(name));
    std::vector<double> radii(trajectory.bead_count(), 0.75);
    check_bounds<3>(trajectory.frames[0], radii);
    for (std::size_t b = 0; b < radii.size(); b += 3) radii[b] = 0.9;
    check_bounds<3>(trajectory.frames[0], radii);
  }
}

/// Returns points for which the layered hierarchy is sqrt(h) times as large as the wrapped one (Lemma 2.5 of
/// Agarwal et al.), which shows that the bound sqrt(h + 1) of Theorem 2.3 is almost tight.
///
/// There are 2^h points in sequence order, 1 <= h <= 24, on the unit circle in the plane z = 0. The sphere of
/// all points has radius 1. In the layered hierarchy, the sphere of any 2^l consecutive points that form a
/// node of the balanced tree has radius l / sqrt(h). Coordinates are rounded once, from `long double`.
Eigen::Matrix3Xd tightness_points(int h) {
  // Works with angles: every point and every centre lies on a ray from the origin, so mirroring a point
  // mirrors its angle.
  std::vector<long double> angles{0};
  long double ray = 0, distance = 1;  // for the centre O_l of the first 2^l points
  const long double leg = 1 / std::sqrt(static_cast<long double>(h));
  for (int l = 0; l + 1 < h; ++l) {
    // O_(l+1) is at the right angle of the triangle O O_(l+1) O_l whose leg O_l O_(l+1) is 1 / sqrt(h).
    const long double next = std::sqrt(distance * distance - leg * leg);
    ray += std::acos(next / distance);
    distance = next;
    for (std::size_t i = 0, built = angles.size(); i < built; ++i) angles.push_back(2 * ray - angles[i]);
  }
  const auto half = static_cast<Eigen::Index>(angles.size());
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2 * half);
  for (Eigen::Index p = 0; p < half; ++p) {
    const long double angle = angles[static_cast<std::size_t>(p)];
    points(0, p) = static_cast<double>(std::cos(angle));
    points(1, p) = static_cast<double>(std::sin(angle));
  }
  points.rightCols(half) = -points.leftCols(half);
  return points;
}

TEST(Tightness, PointsOfLemmaTwoFiveReachTheSquareRootOfTheHeight) {
  for (int h = 1; h <= 9; ++h) {
    const Eigen::Matrix3Xd points = tightness_points(h);
    ASSERT_EQ(points.cols(), 1 << h);
    const std::vector<double> radii(static_cast<std::size_t>(points.cols()), 0);
    const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(points.cols() - 1)}};
    StaticWrappedHierarchy<2> wrapped(necklace);
    LayeredHierarchy<2> layered(necklace);
    const Balls<2> balls(points, radii);
    wrapped.build(balls);
    layered.build(balls);
    EXPECT_NEAR(wrapped.sphere(0).radius, 1, 1e-15);
    EXPECT_NEAR(layered.sphere(0).radius / wrapped.sphere(0).radius, std::sqrt(h), 1e-14 * h);
    check_bounds<2>(points, radii);
  }
}

TEST(Tightness, RatiosOfKnownCages) {
  // Three consecutive beads are wrapped as tightly as layered; a bent chain of four is not.
  Eigen::Matrix3Xd bent(3, 4);
  bent << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  const std::vector<double> radii(4, 0);
  const std::vector<BeadRange> necklace{{0, 3}};
  StaticWrappedHierarchy<3> wrapped(necklace);
  LayeredHierarchy<3> layered(necklace);
  const Balls<3> balls(bent, radii);
  wrapped.build(balls);
  layered.build(balls);
  const Tightness ratios = tightness_of(wrapped, layered);
  EXPECT_NEAR(ratios.least, std::sqrt(0.5), 1e-14);  // half of a diagonal in a circle of radius 1, rounded up
  EXPECT_NEAR(ratios.average, (2 + std::sqrt(0.5)) / 3, 1e-14);
}

}  // namespace
}  // namespace kds::tightness_test
