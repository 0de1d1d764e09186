// The slack of spheres, compared with the bases of balls that have moved that far, computed in integers.

#include "structures/hierarchy/node_slack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::sphere_slack_test {
namespace {

using namespace test;

template <int D>
struct Cloud {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;

  [[nodiscard]] SmallestSphere smallest() const {
    return smallest_sphere(Balls<D>(centers, radii), 0, static_cast<BeadId>(radii.size() - 1), {},
                           ExactUse::everywhere);
  }
  [[nodiscard]] BeadPaths<D> paths() const {
    BezierMotion<D, 1> motion(radii.size());
    for (BeadId b = 0; b < radii.size(); ++b) {
      for (int k = 0; k <= 1; ++k) {
        for (int axis = 0; axis < D; ++axis) motion.set_coordinate(b, k, axis, centers(axis, b));
        motion.set_radius(b, k, radii[b]);
      }
    }
    BeadPaths<D> result;
    result.set(Curves<D>(motion));
    return result;
  }
};

template <int D>
Cloud<D> random_cloud(Random& random, bool equal) {
  Cloud<D> cloud;
  const auto count = static_cast<Eigen::Index>(2 + random() % 9);
  cloud.centers.setZero(3, count);
  const double flat = random() % 3 == 0 ? 0.01 : 1;
  for (Eigen::Index b = 0; b < count; ++b) {
    for (int axis = 0; axis < D; ++axis) cloud.centers(axis, b) = uniform(random) * (axis == 0 ? flat : 1);
    cloud.radii.push_back(equal ? 0.5 : uniform(random, 0.1, 0.4));
  }
  return cloud;
}

/// Moves all balls by `distance`: in random directions, or so that the sphere shrinks and other balls stick
/// out.
template <int D>
Cloud<D> wandered(const Cloud<D>& cloud, const SmallestSphere& smallest, double distance, int how,
                  Random& random) {
  Cloud<D> moved = cloud;
  const Eigen::Vector3d& middle = smallest.sphere.center;
  for (Eigen::Index b = 0; b < cloud.centers.cols(); ++b) {
    Eigen::Vector3d way = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < D; ++axis) way[axis] = uniform(random);
    const bool member = smallest.basis.contains(static_cast<BeadId>(b));
    const Eigen::Vector3d outwards = cloud.centers.col(b) - middle;
    if (how == 1 && outwards.norm() > 0) way = member ? -outwards : outwards;
    if (how == 2 && !member && outwards.norm() > 0) way = outwards;
    if (how == 3 && outwards.norm() > 0) way += (member ? -2 : 2) * outwards.normalized();
    moved.centers.col(b) += way * (distance * (1 - 0x1p-40) / way.norm());
  }
  return moved;
}

struct Tally {
  int asked = 0, proved = 0, changed_beyond = 0;
};

template <int D>
void judge(unsigned seed, bool equal, int exponent, Tally& tally) {
  Random random(seed);
  Cloud<D> cloud = random_cloud<D>(random, equal);
  cloud.centers *= std::ldexp(1.0, exponent);
  for (double& r : cloud.radii) r = std::ldexp(r, exponent);
  const SmallestSphere smallest = cloud.smallest();
  const BeadRange all{0, static_cast<BeadId>(cloud.radii.size() - 1)};
  const double wanted = std::ldexp(1.0, exponent);
  double slack = 0;
  sphere_slack<D>(cloud.paths(), {&all, 1}, {&smallest.basis, 1}, {&wanted, 1}, {&slack, 1});
  ++tally.asked;
  if (!(slack > 0)) return;
  ++tally.proved;
  EXPECT_LE(slack, wanted);
  for (int round = 0; round < 12; ++round) {
    EXPECT_EQ(wandered(cloud, smallest, slack, round % 4, random).smallest().basis, smallest.basis)
        << "seed " << seed << ", round " << round;
    tally.changed_beyond +=
        wandered(cloud, smallest, 8 * slack, round % 4, random).smallest().basis == smallest.basis ? 0 : 1;
  }
}

TEST(SphereTolerance, BasesStayWhileBallsWanderNoFarther) {
  Tally space, plane;
  for (unsigned seed = 0; seed < test::rounds(160U); ++seed) {
    judge<3>(seed, seed % 2 == 0, 0, space);
    judge<2>(seed, seed % 2 == 0, 0, plane);
  }
  for (const Tally& tally : {space, plane}) {
    EXPECT_GT(tally.proved, tally.asked / 2);
    EXPECT_GT(tally.changed_beyond, tally.proved);  // the slack is not far too small either
  }
}

TEST(SphereTolerance, ScalesWithTheInput) {
  for (const int exponent : {-300, -140, 100, 140, 300}) {
    Tally tally;
    for (unsigned seed = 0; seed < 20; ++seed) judge<3>(seed, seed % 2 == 0, exponent, tally);
    EXPECT_EQ(tally.proved > 6, std::abs(exponent) <= 140) << exponent;
    EXPECT_EQ(tally.proved == 0, std::abs(exponent) > 140) << exponent;
  }
}

// A bead on the sphere, a superfluous basis bead and a flat basis leave no slack.
TEST(SphereTolerance, NoneWhereTheBasisIsAboutToChange) {
  Cloud<3> square;
  square.centers.resize(3, 4);
  square.centers << 0, 2, 2, 0, 0, 0, 2, 2, 0, 0, 0, 0;
  square.radii.assign(4, 0.5);
  Cloud<3> line = square;
  line.centers << 0, 1, 2, 0.5, 0, 0, 0, 0, 0, 0, 0, 0;
  const BeadRange all{0, 3};
  const double wanted = 1;
  for (const auto& [cloud, beads] : {std::pair<Cloud<3>, std::vector<BeadId>>{square, {0, 2}},
                                     {square, {0, 1, 2}},
                                     {line, {0, 1, 2}},
                                     {square, {0, 1, 2, 3}}}) {
    const Basis basis(beads);
    double slack = 1;
    sphere_slack<3>(cloud.paths(), {&all, 1}, {&basis, 1}, {&wanted, 1}, {&slack, 1});
    EXPECT_LE(slack, 0);
  }
}

// A pair and two beads well inside its sphere, one of which moves by `away` in the middle of the step. All
// beads swing along x, in some cases so far that differences overflow.
TEST(NodeSlack, ABeadThatGoesAwayAndBackWithinAStep) {
  const std::array y{-1.0, 1.0, 0.0, 0.0}, z{0.0, 0.0, 0.3, 0.2};
  const std::array necklace{BeadRange{0, 3}};
  const NecklaceTree tree(necklace);
  const Basis pair(std::array<BeadId, 2>{0, 1});
  const auto is_skipped = [&](double swing, double away) {
    BezierMotion<3, 2> motion(4);
    for (BeadId b = 0; b < 4; ++b) {
      for (int k = 0; k <= 2; ++k) {
        motion.set_coordinate(b, k, 0, k == 1 ? -swing : swing);
        motion.set_coordinate(b, k, 1, y[b]);
        motion.set_coordinate(b, k, 2, z[b] + (k == 1 && b == 2 ? away : 0));
        motion.set_radius(b, k, 1);
      }
    }
    BeadPaths<3> paths;
    paths.set(Curves<3>(motion));
    NodeSlack<3> slack(tree);
    std::vector<NodeId> nodes{*tree.find(necklace[0])};
    const std::vector<Basis> bases(tree.node_count(), pair);
    slack.take_out_skipped(paths, bases, nodes);
    return nodes.empty();
  };
  EXPECT_TRUE(is_skipped(0, 0));
  EXPECT_TRUE(is_skipped(1, 0));
  for (const double swing : {0.0, 1.0, 1e10, 1.2e308}) EXPECT_FALSE(is_skipped(swing, 50)) << swing;
}

}  // namespace
}  // namespace kds::sphere_slack_test
