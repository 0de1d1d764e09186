#include "structures/hierarchy/layered_hierarchy.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "structures/enclosing_sphere/cage.h"
#include "structures/necklace/balls.h"
#include "tests/support/inputs/ball_sets.h"

namespace kds::layered_hierarchy_test {
namespace {

using namespace test;

/// A reference implementation: the smallest sphere around two spheres, by the textbook formula.
template <int D>
Cage<D> around(const Cage<D>& a, const Cage<D>& b) {
  const Point<D> d = detail::minus(b.center, a.center);
  const double square = detail::dot(d, d);
  const bool sized = square >= 0x1p-900 && square <= 0x1p900;
  const double distance = sized ? std::sqrt(square) : distance_rounded_up<D>(a.center, b.center);
  const double wider = b.radius - a.radius;
  if (distance * (1 + 0x1p-48) <= std::abs(wider)) return wider > 0 ? b : a;
  if (!(std::abs(wider) >= 0)) return a;
  const double ratio = sized ? wider / square * distance : wider / distance;
  const double share = std::clamp(0.5 * (1 + ratio), 0.0, 1.0);
  Cage<D> cage;
  double size = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    cage.center[axis] =
        sized ? a.center[axis] + share * d[axis] : (1 - share) * a.center[axis] + share * b.center[axis];
    size += std::abs(cage.center[axis]);
  }
  const double reach = std::max(0.5 * (distance + (a.radius + b.radius)), std::max(a.radius, b.radius));
  cage.radius = sized ? reach * (1 + 0x1p-49) + 0x1p-51 * size
                      : std::max(reach_rounded_up<D>(cage.center, a.center, a.radius),
                                 reach_rounded_up<D>(cage.center, b.center, b.radius));
  return cage;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

template <int D>
void expect_as_written_down(const BallSet& set) {
  const auto n = static_cast<BeadId>(set.radii.size());
  const std::vector<BeadRange> necklaces{{0, n / 2}, {n / 2 + 1, n - 1}};
  LayeredHierarchy<D> layered(n < 3 ? std::vector<BeadRange>{{0, n - 1}} : necklaces);
  const Balls<D> balls(set.centers, set.radii);
  layered.build(balls);
  const NecklaceTree& tree = layered.tree();
  std::vector<Cage<D>> cages(tree.node_count());
  for (auto node = static_cast<NodeId>(tree.node_count()); node-- > 0;) {
    const auto part = [&](NodeId child, BeadId bead) {
      return child == NecklaceTree::leaf ? balls.rows()[bead] : cages[child];
    };
    cages[node] = around<D>(part(tree.left(node), tree.range(node).first),
                            part(tree.right(node), tree.range(node).last));
    const Sphere sphere = layered.sphere(node);
    for (std::size_t axis = 0; axis < D; ++axis)
      ASSERT_PRED2(same, sphere.center[static_cast<Eigen::Index>(axis)], cages[node].center[axis])
          << set.name << ", node " << node << " of " << n << " beads";
    ASSERT_PRED2(same, sphere.radius, cages[node].radius)
        << set.name << ", node " << node << " of " << n << " beads";
  }
}

TEST(LayeredHierarchy, IsAsWrittenDownOnHardSets) {
  std::mt19937 random(7);
  for (std::size_t which = 0; which < hard_ball_sets; ++which) {
    for (int round = 0; round < 40; ++round) {
      const auto beads = static_cast<Eigen::Index>(1 + random() % 70);
      BallSet set = hard_ball_set(random, which, beads, round % 2 == 0, round % 4 > 1);
      const double scale = std::ldexp(1.0, std::array{0, 0, 430, -460, -530}[random() % 5]);
      set.centers *= scale;
      for (double& radius : set.radii) radius *= random() % 50 == 0 ? 1 : scale;
      if (round % 4 > 1) expect_as_written_down<2>(set);
      expect_as_written_down<3>(set);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(LayeredHierarchy, RadiiThatOverflowAreAsWrittenDown) {
  constexpr double most = std::numeric_limits<double>::max();
  std::mt19937 random(8);
  for (int round = 0; round < 50; ++round) {
    BallSet set = hard_ball_set(random, 0, 12, false, false);
    for (double& radius : set.radii) radius = random() % 2 == 0 ? most : most * 0x1p-40;
    set.centers *= round % 2 == 0 ? 1 : 0x1p1000;
    expect_as_written_down<3>(set);
    if (HasFatalFailure()) return;
  }
}

/// Returns whether the first sphere, as stored, contains the second.
bool holds(const Sphere& outer, const Eigen::Vector3d& center, double radius) {
  Rational square = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational d = Rational(outer.center[axis]) - Rational(center[axis]);
    square += d * d;
  }
  const Rational room = Rational(outer.radius) - Rational(radius);
  return room >= 0 && square <= Rational(room * room);
}

// One ball contains the other, or almost does, up to some ulps. Some sizes have squares outside the range of
// doubles.
TEST(LayeredHierarchy, HoldsTwoBallsExactlyHoweverTheyLie) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> real(-1, 1);
  const std::vector<BeadRange> pairs{{0, 1}, {2, 3}, {4, 5}, {6, 7}, {8, 9}};
  LayeredHierarchy<3> layered(pairs);
  for (int round = 0; round < 4000; ++round) {
    const double scale = std::ldexp(1.0, std::array{0, 0, 0, 445, 500, -440, -470, -520}[random() % 8]);
    Eigen::Matrix3Xd centers(3, 10);
    std::vector<double> radii(10);
    for (BeadId b = 0; b < 10; b += 2) {
      const double offset = random() % 4 == 0 ? 0x1p30 : 0;
      const Eigen::Vector3d there(real(random) + offset, real(random), real(random));
      const Eigen::Vector3d apart =
          std::ldexp(1.0, -static_cast<int>(random() % 60)) * Eigen::Vector3d(real(random), real(random), 0);
      centers.col(b) = scale * there;
      centers.col(b + 1) = scale * (there + apart);
      const double distance = (centers.col(b + 1) / scale - centers.col(b) / scale).norm();
      const double small = random() % 3 == 0 ? 0 : std::abs(real(random));
      const double ulps = static_cast<double>(static_cast<int>(random() % 129) - 64) * 0x1p-52;
      const double large = random() % 3 == 0 ? std::abs(real(random)) : (small + distance) * (1 + ulps);
      radii[b] = scale * (random() % 2 == 0 ? small : large);
      radii[b + 1] = scale * (radii[b] == scale * small ? large : small);
    }
    layered.build(Balls<3>(centers, radii));
    for (NodeId node = 0; node < 5; ++node)
      for (BeadId b = 2 * node; b <= 2 * node + 1; ++b)
        ASSERT_TRUE(holds(layered.sphere(node), centers.col(b), radii[b])) << round << ", bead " << b;
  }
}

TEST(LayeredHierarchy, HoldsItsChildrenTouchingThem) {
  std::mt19937 random(3);
  const BallSet set = hard_ball_set(random, 0, 100, false, false);
  const std::vector<BeadRange> necklace{{0, 99}};
  LayeredHierarchy<3> layered(necklace);
  const Balls<3> balls(set.centers, set.radii);
  layered.build(balls);
  const NecklaceTree& tree = layered.tree();
  for (NodeId node = 0; node < tree.node_count(); ++node) {
    const Sphere cage = layered.sphere(node);
    double reach[2];
    double radius[2];
    for (int side = 0; side < 2; ++side) {
      const NodeId child = side == 0 ? tree.left(node) : tree.right(node);
      const BeadId bead = side == 0 ? tree.range(node).first : tree.range(node).last;
      const Sphere part = child == NecklaceTree::leaf ? Sphere{set.centers.col(bead), set.radii[bead]}
                                                      : layered.sphere(child);
      reach[side] = (part.center - cage.center).norm() + part.radius;
      radius[side] = part.radius;
      EXPECT_LE(reach[side], cage.radius * (1 + 1e-13));
    }
    if (cage.radius == radius[0] || cage.radius == radius[1]) continue;  // one ball contains the other
    for (const double r : reach) EXPECT_NEAR(r, cage.radius, 1e-13 * cage.radius);
  }
}

}  // namespace
}  // namespace kds::layered_hierarchy_test
