// Separating families: a damaged family is detected, and the sizes agree with the theorem.

#include "structures/collision/hierarchy_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "motions/models/shapes.h"

namespace kds::separating_family_test {
namespace {

using testing::HasSubstr;

/// A grid without collisions. On request, two beads are moved into each other.
struct Scene {
  Eigen::Matrix3Xd centers = models::packed_grid(150, 3, 0.05);
  std::vector<double> radii = std::vector<double>(150, 1);
  PairsAsked asked{{{0, 149}}, true, 2, true};
  SeparatingFamily family;
  std::vector<BeadPair> pairs;

  explicit Scene(bool collides = false) {
    if (collides) centers.col(70) = centers.col(20);
    SphereTree<3> tree(Hierarchy::wrapped, asked.necklaces);
    tree.build(balls());
    pairs = find_pairs(tree, asked, family).pairs;
  }
  [[nodiscard]] Balls<3> balls() const { return {centers, radii}; }
  [[nodiscard]] std::string fault() const {
    return family_fault(family, pairs, balls(), asked).value_or("none");
  }
};

TEST(SeparatingFamily, ASoundOneHasNoFault) {
  EXPECT_EQ(Scene().fault(), "none");
  const Scene colliding(true);
  EXPECT_FALSE(colliding.pairs.empty());
  EXPECT_EQ(colliding.fault(), "none");
}

TEST(SeparatingFamily, EachPairIsNeeded) {
  Scene scene;
  for (std::size_t k = 0; k < scene.family.pairs.size(); k += 7) {
    const SeparatingFamily::Pair pair = scene.family.pairs[k];
    const BeadRange a = scene.family.spheres[pair.first].beads, b = scene.family.spheres[pair.second].beads;
    scene.family.pairs.erase(scene.family.pairs.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_THAT(scene.fault(), HasSubstr("are not separated")) << a.first << " " << b.first;
    scene.family.pairs.push_back(pair);  // the order of pairs is free
    EXPECT_EQ(scene.fault(), "none");
  }
}

TEST(SeparatingFamily, NoPairOfBeadsIsCoveredTwice) {
  Scene scene;
  scene.family.pairs.push_back(scene.family.pairs.front());
  EXPECT_THAT(scene.fault(), HasSubstr("separated twice"));
  scene = Scene();
  const auto pair = scene.family.pairs[5];
  scene.family.pairs.push_back({pair.second, pair.first});
  EXPECT_THAT(scene.fault(), HasSubstr("separated twice"));
}

TEST(SeparatingFamily, SpheresHoldTheirBeadsAndAreDisjoint) {
  Scene scene;
  for (auto& sphere : scene.family.spheres) sphere.radius *= 1.2;
  EXPECT_THAT(scene.fault(), HasSubstr("are not disjoint"));
  scene = Scene();
  const auto pair = scene.family.pairs[3];
  scene.family.spheres[pair.first].radius *= 1 - 0x1p-40;
  EXPECT_THAT(scene.fault(), HasSubstr("sticks out"));
  scene = Scene();
  scene.family.spheres[pair.second].center[1] += 1e-3;
  EXPECT_THAT(scene.fault(), HasSubstr("sticks out"));
  scene = Scene();
  scene.family.spheres[pair.second].beads.last = 200;
  EXPECT_THAT(scene.fault(), HasSubstr("beads that there are not"));
  scene = Scene();
  scene.family.pairs[2].first = 1000;
  EXPECT_THAT(scene.fault(), HasSubstr("a sphere that there is not"));
}

TEST(SeparatingFamily, CollisionsAreNoPartOfIt) {
  const Scene sound(true);
  Scene scene = sound;
  scene.pairs.erase(scene.pairs.begin());
  EXPECT_THAT(scene.fault(), HasSubstr("are not separated"));
  scene = sound;
  scene.pairs.push_back({149, 150});
  EXPECT_THAT(scene.fault(), HasSubstr("collisions are not of these beads"));
  scene = sound;
  scene.pairs.insert(scene.pairs.begin(), BeadPair{0, 1});
  EXPECT_THAT(scene.fault(), HasSubstr("the query does not ask"));
  scene = Scene();
  scene.pairs = {{20, 70}};
  EXPECT_THAT(scene.fault(), HasSubstr("twice"));  // the pair is also separated
}

/// A disjoint pair is listed as a collision instead of being separated.
TEST(SeparatingFamily, WhatIsCalledACollisionIsOne) {
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, 2);
  centers(0, 1) = 5;
  const std::vector<BeadPair> called{{0, 1}};
  const auto fault = family_fault(SeparatingFamily(), called, Balls<3>(centers, std::vector<double>(2, 1)),
                                  {{{0, 1}}, true, 1, true});
  ASSERT_TRUE(fault);
  EXPECT_THAT(*fault, HasSubstr("are disjoint, but not separated"));
}

/// Complete grids without collisions whose sides are not powers of two.
template <int Dimension>
std::uint64_t family_of_grid(Hierarchy kind, std::size_t side) {
  const std::size_t rows = Dimension == 2 ? side : side * side;
  const Eigen::Matrix3Xd centers = models::packed_grid(rows * side + rows - 1, Dimension, 0.05);
  const std::vector<double> radii(static_cast<std::size_t>(centers.cols()), 1.0);
  const PairsAsked asked{{{0, static_cast<BeadId>(radii.size() - 1)}}, true, 2, true};
  SphereTree<Dimension> tree(kind, asked.necklaces);
  tree.build(Balls<Dimension>(centers, radii));
  const PairsFound found = find_pairs(tree, asked);
  EXPECT_TRUE(found.pairs.empty());
  return found.family;
}

TEST(SeparatingFamily, SizesOfPackedGrids) {
  for (const Hierarchy kind : {Hierarchy::wrapped, Hierarchy::layered}) {
    for (const std::size_t side : {23, 51, 99}) {
      const double n = static_cast<double>(side * side + side - 1);
      const double ratio = static_cast<double>(family_of_grid<2>(kind, side)) / (n * std::log2(n));
      EXPECT_GT(ratio, 0.4) << side;
      EXPECT_LT(ratio, 2.5) << side;
    }
    for (const std::size_t side : {7, 13, 21}) {
      const double n = static_cast<double>(side * side * side + side * side - 1);
      const double ratio = static_cast<double>(family_of_grid<3>(kind, side)) / std::pow(n, 4.0 / 3);
      EXPECT_GT(ratio, 1) << side;
      EXPECT_LT(ratio, 10) << side;
    }
  }
}

}  // namespace
}  // namespace kds::separating_family_test
