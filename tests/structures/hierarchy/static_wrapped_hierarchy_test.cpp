#include "structures/hierarchy/static_wrapped_hierarchy.h"

#include <gmock/gmock.h>

#include <numeric>

#include "structures/hierarchy/layered_hierarchy.h"
#include "tests/support/inputs/ball_sets.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::static_wrapped_hierarchy_test {
namespace {

using namespace test;

Trajectory frames_of(const std::string& name, FrameRange range) {
  ReadOptions options;
  options.frames = range;
  return read_trajectory(data(name), options);
}

// Splits the beads into several necklaces, one of which has a single bead.
std::vector<BeadRange> split(std::size_t beads) {
  const auto n = static_cast<BeadId>(beads);
  if (n < 12) return {{0, n - 1}};
  return {{0, n / 3}, {n / 3 + 1, n / 3 + 1}, {n / 3 + 2, n - 1}};
}

template <int D>
void expect_exact(const StaticWrappedHierarchy<D>& hierarchy, const BallSet& set) {
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const BeadRange range = hierarchy.tree().range(node);
    const Basis& basis = hierarchy.basis(node);
    ASSERT_EQ(not_smallest_ball(set, range.first, range.last, {basis.begin(), basis.end()},
                                hierarchy.sphere(node).radius),
              std::nullopt)
        << set.name << ", beads " << range.first << "-" << range.last;
  }
}

template <int D>
void expect_same(const StaticWrappedHierarchy<D>& a, const StaticWrappedHierarchy<D>& b) {
  for (NodeId node = 0; node < a.tree().node_count(); ++node) {
    ASSERT_EQ(a.basis(node), b.basis(node)) << node;
    ASSERT_EQ(a.sphere(node).center, b.sphere(node).center) << node;  // bit for bit
    ASSERT_EQ(a.sphere(node).radius, b.sphere(node).radius) << node;
  }
}

template <class D>
class StaticWrappedHierarchyIn : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(StaticWrappedHierarchyIn, Dimensions);

TYPED_TEST(StaticWrappedHierarchyIn, IsExactOnHardSetsBuiltAndUpdated) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(91 + d);
  for (int round = 0; round < 8; ++round) {
    for (std::size_t which = 0; which < hard_ball_sets; ++which) {
      const auto beads = static_cast<Eigen::Index>(2 + random() % 30);
      BallSet set = hard_ball_set(random, which, beads, round % 2 == 0, d == 2);
      const auto necklaces = split(set.radii.size());
      StaticWrappedHierarchy<d> hierarchy(necklaces);
      Balls<d> balls(set.centers, set.radii);
      const WrapCounts built = hierarchy.build(balls);
      EXPECT_EQ(built.changed, hierarchy.tree().node_count());
      expect_exact(hierarchy, set);
      const WrapCounts again = hierarchy.update(balls);
      EXPECT_TRUE(again.exact > 0 || again.changed == 0) << set.name;
      expect_exact(hierarchy, set);
      // Moves the beads to a different set and back. Each update starts with the bases of the set before it.
      const BallSet other = hard_ball_set(random, (which + 1) % hard_ball_sets, beads, true, d == 2);
      balls.move_to(other.centers);
      hierarchy.update(balls);
      expect_exact(hierarchy, {other.name, other.centers, set.radii});
      balls.move_to(set.centers);
      hierarchy.update(balls);
      expect_exact(hierarchy, set);
    }
  }
}

TEST(StaticWrappedHierarchy, IsExactOnTrajectories) {
  for (const std::string name : {"villin_hp36_300K.dcd", "random100_400K_first200.dcd"}) {
    const Trajectory trajectory = frames_of("trajectories/" + name, {0, 40, 13});
    const std::size_t beads = std::min<std::size_t>(trajectory.bead_count(), 150);
    for (const bool equal : {true, false}) {
      std::vector<double> radii(beads, 0.8);
      for (std::size_t b = 0; b < beads && !equal; ++b)
        radii[b] = 0.5 + 0.1 * static_cast<double>(b * 7 % 10);
      const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(beads - 1)}};
      StaticWrappedHierarchy<3> hierarchy(necklace);
      std::uint64_t exact = 0;
      for (const Eigen::Matrix3Xd& all : trajectory.frames) {
        const Eigen::Matrix3Xd centers = all.leftCols(static_cast<Eigen::Index>(beads));
        exact += hierarchy.update(Balls<3>(centers, radii)).exact;
        expect_exact(hierarchy, {name, centers, radii});
      }
      EXPECT_EQ(exact, 0U) << "doubles suffice";
    }
  }
}

// A build looks at pairs one by one; an update looks at four pairs at a time.
TYPED_TEST(StaticWrappedHierarchyIn, PairsUpdatedAreThoseBuilt) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(57 + d);
  for (int round = 0; round < 60; ++round) {
    for (std::size_t which = 0; which < hard_ball_sets; ++which) {
      const auto pairs = static_cast<BeadId>(1 + random() % 9);
      std::vector<BeadRange> necklaces;
      for (BeadId pair = 0; pair < pairs; ++pair) necklaces.push_back({2 * pair, 2 * pair + 1});
      const BallSet before = hard_ball_set(random, random() % hard_ball_sets, 2 * pairs, true, d == 2);
      const BallSet set = hard_ball_set(random, which, 2 * pairs, round % 2 == 0, d == 2);
      StaticWrappedHierarchy<d> built(necklaces), updated(necklaces);
      built.build(Balls<d>(set.centers, set.radii));
      updated.build(Balls<d>(before.centers, before.radii));
      updated.update(Balls<d>(set.centers, set.radii));
      expect_same(built, updated);
      std::vector<NodeId> loose, loose_of_updated;
      built.visit_loose([&](NodeId node) { loose.push_back(node); });
      updated.visit_loose([&](NodeId node) { loose_of_updated.push_back(node); });
      EXPECT_EQ(loose, loose_of_updated);
      if (this->HasFailure()) FAIL() << set.name;
    }
  }
}

// Trees of very different sizes, the largest with many subtrees that are passed one by one.
TEST(StaticWrappedHierarchy, OfLargeAndSmallNecklacesTogether) {
  std::mt19937 random(17);
  std::normal_distribution<double> step;
  const Eigen::Index beads = 14'200;
  Eigen::Matrix3Xd centers(3, beads);
  Eigen::Vector3d at(0, 0, 0);
  for (Eigen::Index b = 0; b < beads; ++b)
    centers.col(b) = at += Eigen::Vector3d(step(random), step(random), step(random));
  for (const bool equal : {true, false}) {
    std::vector<double> radii(static_cast<std::size_t>(beads), 0.5);
    for (std::size_t b = 0; b < radii.size() && !equal; b += 3) radii[b] = 0.7;
    const std::vector<BeadRange> necklaces{{0, 13'999}, {14'000, 14'001}, {14'002, 14'199}};
    StaticWrappedHierarchy<3> one(necklaces);
    Balls<3> balls(centers, radii);
    one.build(balls);
    const Eigen::Matrix3Xd moved = 1.01 * centers + 0.02 * Eigen::Matrix3Xd::Random(3, beads);
    balls.move_to(moved);
    EXPECT_GT(one.update(balls).changed, 0U);
    // A fresh build gives the same spheres; a few spheres are checked from the definition.
    StaticWrappedHierarchy<3> fresh(necklaces);
    fresh.build(balls);
    expect_same(one, fresh);
    const BallSet set{"walk", moved, radii};
    for (const NodeId node : {13'998U, 13'999U, 14'000U, 14'002U}) {
      const BeadRange range = one.tree().range(node);
      const Basis& basis = one.basis(node);
      ASSERT_EQ(not_smallest_ball(set, range.first, range.last, {basis.begin(), basis.end()},
                                  one.sphere(node).radius),
                std::nullopt);
    }
  }
}

struct Walk {
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;
  std::vector<BeadRange> necklaces;
};

// Makes a random walk of beads, and frames in which the beads jitter.
Walk jittering_walk(Eigen::Index beads, bool equal, double jitter) {
  std::mt19937 random(29);
  std::normal_distribution<double> step;
  Walk walk;
  Eigen::Matrix3Xd centers(3, beads);
  Eigen::Vector3d at(0, 0, 0);
  for (Eigen::Index b = 0; b < beads; ++b)
    centers.col(b) = at += Eigen::Vector3d(step(random), step(random), step(random)).normalized();
  for (int k = 0; k < 4; ++k) {
    walk.frames.push_back(centers);
    for (double& x : centers.reshaped()) x += jitter * step(random);
  }
  walk.radii.assign(static_cast<std::size_t>(beads), 0.5);
  for (std::size_t b = 0; b < walk.radii.size() && !equal; b += 3) walk.radii[b] = 0.4;
  walk.necklaces = {{0, static_cast<BeadId>(beads - 1)}};
  return walk;
}

TEST(StaticWrappedHierarchy, EveryVerificationGivesTheSameAndCountsItsTests) {
  for (const bool equal : {true, false}) {
    const Walk walk = jittering_walk(700, equal, 0.01);
    StaticWrappedHierarchy<3> naive(walk.necklaces), cascade(walk.necklaces), blocks(walk.necklaces);
    std::uint64_t all = 0;
    Balls<3> balls(walk.frames[0], walk.radii);
    naive.build(balls);
    cascade.build(balls);
    blocks.build(balls);
    for (NodeId node = 0; node < naive.tree().node_count(); ++node)
      if (naive.tree().range(node).last - naive.tree().range(node).first > 1)
        all += naive.tree().range(node).last - naive.tree().range(node).first + 1;
    std::uint64_t before = 0;
    for (std::size_t k = 0; k < walk.frames.size(); ++k) {
      balls.move_to(walk.frames[k]);
      const WrapCounts n = naive.update(balls, Update::naive);
      const WrapCounts c = cascade.update(balls, Update::cascade);
      const WrapCounts b = blocks.update(balls, Update::blocks);
      expect_same(naive, cascade);
      expect_same(naive, blocks);
      EXPECT_EQ(n.changed, c.changed);
      EXPECT_EQ(n.changed, b.changed);
      EXPECT_EQ(n.cage_tests, 0U);
      EXPECT_TRUE(k > 0 || n.bead_tests == all);  // the first update has nothing to repair
      EXPECT_LT(b.bead_tests, n.bead_tests);
      EXPECT_LT(c.bead_tests + c.cage_tests, n.bead_tests);
      // Beads at rest: the cascade starts from its last result.
      const WrapCounts again = cascade.update(balls, Update::cascade);
      if (k == 0) {
        EXPECT_LT(again.bead_tests + again.cage_tests, c.bead_tests + c.cage_tests);
        EXPECT_EQ(again.frontier, c.frontier);
        EXPECT_GT(again.frontier, 2 * naive.tree().node_count() - 1);
        before = again.frontier;
      }
      EXPECT_EQ(again.changed, 0U);
    }
    EXPECT_GT(before, 0U);
  }
}

TEST(StaticWrappedHierarchy, TrustedBasesStayAndBeadsStickOut) {
  for (const bool equal : {true, false}) {
    const Walk walk = jittering_walk(300, equal, 0.05);
    StaticWrappedHierarchy<3> trusting(walk.necklaces), lazy(walk.necklaces);
    const Balls<3> first(walk.frames[0], walk.radii);
    trusting.build(first);
    lazy.build(first);
    std::size_t out = 0;
    for (std::size_t k = 1; k < walk.frames.size(); ++k) {
      const Balls<3> balls(walk.frames[k], walk.radii);
      EXPECT_EQ(trusting.update(balls, Update::trust).bead_tests, 0U);
      lazy.update(balls, Update::lazy);
      for (NodeId node = 0; node < trusting.tree().node_count(); ++node) {
        const Sphere sphere = trusting.sphere(node);
        ASSERT_NEAR(sphere.radius, lazy.sphere(node).radius, 1e-13 * sphere.radius);
        const BeadRange range = trusting.tree().range(node);
        double sticks = 0;
        for (BeadId b = range.first; b <= range.last; ++b)
          sticks = std::max(sticks,
                            (walk.frames[k].col(b) - sphere.center).norm() + walk.radii[b] - sphere.radius);
        out += sticks > 1e-9 ? 1 : 0;
      }
    }
    EXPECT_GT(out, 0U);
    // A verified update is exact and equal to a fresh build.
    const Balls<3> last(walk.frames.back(), walk.radii);
    StaticWrappedHierarchy<3> fresh(walk.necklaces);
    fresh.build(last);
    trusting.update(last);
    lazy.update(last);
    expect_same(fresh, trusting);
    expect_same(fresh, lazy);
  }
}

}  // namespace
}  // namespace kds::static_wrapped_hierarchy_test
