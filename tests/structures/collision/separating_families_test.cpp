// The explicit family of Theorem 3.1, the smallest family, and the families of other search rules: each
// covers every pair of beads as it promises, and their sizes are in order. Twins follow the definitions.

#include "structures/collision/separating_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "motions/models/shapes.h"
#include "structures/hierarchy/bead_orders.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/rounds.h"

namespace kds::separating_families_test {
namespace {

using test::CollisionScene;
using test::Random;
using test::uniform;
using testing::HasSubstr;

/// A random chain whose consecutive beads meet, straight or coiled. Other beads may collide.
CollisionScene connected_chain(Random& random, std::size_t beads, int dimension) {
  CollisionScene scene;
  scene.asked = {{{0, static_cast<BeadId>(beads - 1)}}, true, static_cast<BeadId>(2 + random() % 3), true};
  const bool equal = random() % 2 == 0;
  const double stiffness = uniform(random, 0, 3);
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), ahead = Eigen::Vector3d::UnitX();
  scene.centers.resize(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) {
    scene.radii.push_back(equal ? 1 : uniform(random, 0.3, 1));
    if (b > 0) {
      for (Eigen::Index axis = 0; axis < dimension; ++axis) ahead[axis] += uniform(random, -1, 1);
      ahead /= ahead.norm() + 1e-9;
      at += ahead * (scene.radii[b - 1] + scene.radii[b]) * uniform(random, 0.5, 0.999);
      ahead *= stiffness;
    }
    scene.centers.col(static_cast<Eigen::Index>(b)) = at;
  }
  return scene;
}

template <int Dimension>
SphereTree<Dimension> tree_of(Hierarchy kind, const CollisionScene& scene) {
  SphereTree<Dimension> tree(kind, scene.asked.necklaces);
  tree.build(Balls<Dimension>(scene.centers, scene.radii));
  return tree;
}

/// Counts how many pairs of the family cover each pair of beads, in a square table, from the definition.
/// Checks that the spheres of each pair are disjoint and hold their beads.
std::vector<int> covers_of(const SeparatingFamily& family, const CollisionScene& scene) {
  const std::size_t n = scene.radii.size();
  std::vector<int> covers(n * n, 0);
  for (const auto& pair : family.pairs) {
    const FamilySphere &a = family.spheres[pair.first], &b = family.spheres[pair.second];
    EXPECT_GT(compare_distance(a.center, b.center, a.radius, b.radius), 0) << scene.name;
    for (const FamilySphere* sphere : {&a, &b})
      for (BeadId k = sphere->beads.first; k <= sphere->beads.last; ++k)
        EXPECT_LE(compare_distance(scene.centers.col(k), sphere->center, sphere->radius, -scene.radii[k]), 0);
    for (BeadId i = a.beads.first; i <= a.beads.last; ++i)
      for (BeadId j = b.beads.first; j <= b.beads.last; ++j) ++covers[std::min(i, j) * n + std::max(i, j)];
  }
  return covers;
}

/// Checks that each pair of beads asked for is covered `exactly` once, or at least once, unless it collides.
void expect_covered(const SeparatingFamily& family, const CollisionScene& scene, int dimension,
                    bool exactly) {
  const std::size_t n = scene.radii.size();
  const std::vector<int> covers = covers_of(family, scene);
  const std::vector<BeadPair> colliding = test::all_pairs(scene.centers, scene.radii, scene.asked, dimension);
  for (BeadId i = 0; i < n; ++i)
    for (BeadId j = i + 1; j < n; ++j) {
      const int count = covers[i * n + j];
      const bool collides = std::ranges::binary_search(colliding, BeadPair{i, j});
      if (collides) {
        EXPECT_EQ(count, 0) << i << " " << j;
      } else if (scene.asked.asks({i, j})) {
        EXPECT_GE(count, 1) << i << " " << j << " " << scene.name;
      }
      if (exactly) {
        EXPECT_LE(count, 1) << i << " " << j << " " << scene.name;
      }
    }
}

/// Searches through all families over pairs of nodes, for at most 8 beads of one necklace.
template <int Dimension>
class Exhaustive {
 public:
  Exhaustive(const SphereTree<Dimension>& tree, const CollisionScene& scene, bool may_overlap)
      : may_overlap_(may_overlap) {
    const auto spheres = tree.spheres();
    const auto n = static_cast<BeadId>(scene.radii.size());
    const auto bit = [n](BeadId i, BeadId j) { return std::uint64_t{1} << (i * n + j); };
    for (const auto& a : spheres)
      for (const auto& b : spheres) {
        if (a.last >= b.first) continue;
        Eigen::Vector3d p = Eigen::Vector3d::Zero(), q = p;
        for (int axis = 0; axis < Dimension; ++axis) {
          p[axis] = a.center[static_cast<std::size_t>(axis)];
          q[axis] = b.center[static_cast<std::size_t>(axis)];
        }
        const bool apart = compare_distance(p, q, a.radius, b.radius) > 0;
        std::uint64_t cells = 0;
        for (BeadId i = a.first; i <= a.last; ++i)
          for (BeadId j = b.first; j <= b.last; ++j) cells |= bit(i, j);
        if (apart) products_.push_back(cells);
        if (a.is_bead() && b.is_bead() && apart && scene.asked.asks({a.first, b.first})) wanted_ |= cells;
      }
  }
  std::size_t least() {
    descend(0, 0);
    return best_;
  }

 private:
  void descend(std::uint64_t covered, std::size_t size) {
    const std::uint64_t missing = wanted_ & ~covered;
    if (missing == 0) best_ = std::min(best_, size);
    if (missing == 0 || size + 1 >= best_) return;
    const std::uint64_t next = missing & (~missing + 1);
    for (const std::uint64_t cells : products_)
      if ((cells & next) != 0 && (may_overlap_ || (cells & covered) == 0)) descend(covered | cells, size + 1);
  }

  bool may_overlap_;
  std::uint64_t wanted_ = 0;
  std::vector<std::uint64_t> products_;
  std::size_t best_ = std::numeric_limits<std::size_t>::max();
};

constexpr std::array kinds{Hierarchy::wrapped, Hierarchy::layered};
constexpr std::array splits{Split::more_beads, Split::larger_sphere, Split::first_node};

/// Checks the smallest family, and the family of one search rule, which `k` chooses.
template <int Dimension>
void expect_sound_families(const CollisionScene& scene, std::size_t k) {
  constexpr std::array<BeadId, 3> leaves{1, 2, 5};
  const SearchRule rule{splits[k % 3], leaves[k / 3 % 3]};
  for (const Hierarchy kind : kinds) {
    const SphereTree<Dimension> tree = tree_of<Dimension>(kind, scene);
    const Balls<Dimension> balls(scene.centers, scene.radii);
    const std::vector<BeadPair> colliding =
        test::all_pairs(scene.centers, scene.radii, scene.asked, Dimension);
    SeparatingFamily family;
    const PairsFound smallest = smallest_family(tree, scene.asked, &family);
    EXPECT_EQ(smallest.pairs, colliding) << scene.name;
    EXPECT_EQ(smallest.family, family.pairs.size());
    EXPECT_EQ(family_fault(family, colliding, balls, scene.asked).value_or("none"), "none") << scene.name;
    EXPECT_EQ(smallest_family(tree, scene.asked).family, smallest.family);
    const PairsFound found = find_pairs(tree, scene.asked, rule, &family);
    EXPECT_EQ(found.pairs, colliding) << scene.name;
    EXPECT_EQ(found.family, family.pairs.size());
    EXPECT_GE(found.tests, found.family + found.pairs.size());
    EXPECT_EQ(family_fault(family, colliding, balls, scene.asked).value_or("none"), "none") << scene.name;
    EXPECT_GE(found.family, smallest.family);
    if (rule.split == Split::more_beads && rule.leaf == 1) {
      EXPECT_EQ(find_pairs(tree, scene.asked).family, found.family);
      EXPECT_EQ(find_pairs(tree, scene.asked).tests, found.tests);
    }
  }
}

TEST(SeparatingFamilies, OfRandomScenesCoverEachPairOnce) {
  Random random(31);
  for (std::size_t k = 0; k < test::rounds(153U, 18U); ++k) {  // each rule 17 times
    const CollisionScene scene = test::random_scene(random, 40);
    expect_sound_families<3>(scene, k);
    expect_sound_families<2>(scene, k);
  }
}

template <int Dimension>
void expect_families_of_chains(std::uint64_t seed) {
  Random random(seed);
  for (int k = 0; k < 60; ++k) {
    const bool complete = k % 2 == 0;  // a complete binary tree
    const std::size_t beads = complete ? std::size_t{1} << (1 + random() % 7) : 2 + random() % 90;
    CollisionScene scene = connected_chain(random, beads, Dimension);
    scene.name = std::to_string(k);
    for (const Hierarchy kind : kinds) {
      const SphereTree<Dimension> tree = tree_of<Dimension>(kind, scene);
      SeparatingFamily written, smallest;
      const std::uint64_t size = explicit_family(tree, scene.asked, &written);
      EXPECT_EQ(size, written.pairs.size());
      EXPECT_EQ(size, explicit_family(tree, scene.asked));
      expect_covered(written, scene, Dimension, false);
      static_cast<void>(smallest_family(tree, scene.asked, &smallest));
      expect_covered(smallest, scene, Dimension, true);
      EXPECT_LE(smallest.pairs.size(), size);
      // On a complete tree, the search reaches pairs of one depth, which are pairs of the explicit family
      // too, and pairs of two adjacent depths, in place of two or more.
      if (complete) {
        EXPECT_LE(find_pairs(tree, scene.asked).family, size) << scene.name;
      }
    }
  }
}

TEST(SeparatingFamilies, OfChainsInThePlaneAreInOrder) { expect_families_of_chains<2>(7); }
TEST(SeparatingFamilies, OfChainsInSpaceAreInOrder) { expect_families_of_chains<3>(8); }

/// Grouped by space, only neighbours along the chain meet, and all other pairs are covered once.
TEST(SeparatingFamilies, GroupedBySpaceCoverEachPairOnce) {
  const Eigen::Matrix3Xd chain = models::packed_grid(220, 3, 0.05);
  const std::vector<BeadId> order = order_by_space(chain);
  CollisionScene scene;
  scene.centers = in_order(chain, order);
  scene.radii.assign(220, models::radius);
  scene.asked = {{{0, 219}}, true, 1, true};
  for (const Hierarchy kind : kinds) {
    SeparatingFamily family;
    const PairsFound found = find_pairs(tree_of<3>(kind, scene), scene.asked, family);
    expect_covered(family, scene, 3, true);
    EXPECT_EQ(found.pairs.size(), 219U);
    for (const BeadPair& pair : found.pairs)
      EXPECT_EQ(std::max(order[pair.first], order[pair.second]),
                std::min(order[pair.first], order[pair.second]) + 1);
  }
}

/// The nodes of one depth after another, by halving ranges of beads.
std::vector<std::vector<BeadRange>> depths_of(std::size_t beads) {
  std::vector<std::vector<BeadRange>> depths{{{0, static_cast<BeadId>(beads - 1)}}};
  while (std::ranges::any_of(depths.back(), [](const BeadRange& r) { return r.first < r.last; })) {
    std::vector<BeadRange> next;
    for (const BeadRange& range : depths.back()) {
      const BeadId middle = range.first + (range.last - range.first) / 2;
      next.push_back({range.first, middle});
      if (range.first < range.last) next.push_back({middle + 1, range.last});
    }
    depths.push_back(next);
  }
  return depths;
}

/// The explicit family by its definition, from all pairs of nodes of a depth.
template <int Dimension>
std::vector<std::pair<BeadRange, BeadRange>> defined_family(const SphereTree<Dimension>& tree,
                                                            const CollisionScene& scene) {
  const auto sphere_of = [&](const BeadRange& range) {
    return *std::ranges::find_if(tree.spheres(), [&](const auto& sphere) {
      return sphere.first == range.first && sphere.last == range.last;
    });
  };
  const double largest = *std::ranges::max_element(scene.radii);
  std::vector<std::pair<BeadRange, BeadRange>> family;
  for (const std::vector<BeadRange>& nodes : depths_of(scene.radii.size())) {
    BeadId most = 0;
    for (const BeadRange& node : nodes) most = std::max(most, node.last - node.first + 1);
    for (std::size_t j = 0; j < nodes.size(); ++j)
      for (std::size_t k = j + 1; k < nodes.size(); ++k) {
        const auto a = sphere_of(nodes[j]), b = sphere_of(nodes[k]);
        double square = 0;
        for (std::size_t axis = 0; axis < Dimension; ++axis)
          square += std::pow(a.center[axis] - b.center[axis], 2);
        const double distance = std::sqrt(square), within = 8 * largest * most;
        const bool is_inside =
            distance + b.radius <= a.radius + within || distance + a.radius <= b.radius + within;
        const bool asked = b.last - a.first >= scene.asked.apart;
        if (asked && is_inside && distance > a.radius + b.radius) family.emplace_back(nodes[j], nodes[k]);
      }
  }
  const auto key = [](const auto& p) {
    return std::array{p.first.first, p.first.last, p.second.first, p.second.last};
  };
  std::ranges::sort(family, {}, key);
  const auto repeated = std::ranges::unique(family, {}, key);
  family.erase(repeated.begin(), repeated.end());
  return family;
}

TEST(ExplicitFamily, IsTheOneDefined) {
  Random random(5);
  for (int k = 0; k < 12; ++k) {
    const CollisionScene scene = connected_chain(random, 60 + random() % 60, 3);
    for (const Hierarchy kind : kinds) {
      const SphereTree<3> tree = tree_of<3>(kind, scene);
      SeparatingFamily family;
      static_cast<void>(explicit_family(tree, scene.asked, &family));
      std::vector<std::pair<BeadRange, BeadRange>> pairs;
      for (const auto& pair : family.pairs)
        pairs.emplace_back(family.spheres[pair.first].beads, family.spheres[pair.second].beads);
      std::ranges::sort(pairs, {}, [](const auto& p) {
        return std::array{p.first.first, p.first.last, p.second.first, p.second.last};
      });
      EXPECT_EQ(pairs, defined_family(tree, scene));
      EXPECT_LT(pairs.size(), 60 * 60 * 8U);
    }
  }
  // A straight chain is longer than 8 R at the lowest depths, so that far pairs are left out there.
  CollisionScene straight;
  straight.asked = {{{0, 127}}, true, 2, true};
  straight.centers = Eigen::Matrix3Xd::Zero(3, 128);
  straight.radii.assign(128, 1);
  for (Eigen::Index b = 0; b < 128; ++b) straight.centers(0, b) = 1.999 * static_cast<double>(b);
  const SphereTree<3> tree = tree_of<3>(Hierarchy::wrapped, straight);
  EXPECT_EQ(explicit_family(tree, straight.asked), defined_family(tree, straight).size());
  EXPECT_LT(explicit_family(tree, straight.asked), 128 * 8U);
}

TEST(SmallestFamily, IsThatOfAnExhaustiveSearch) {
  Random random(77);
  std::size_t smaller_with_overlap = 0, below_the_search = 0;
  for (int k = 0; k < 400; ++k) {
    const CollisionScene scene = connected_chain(random, 4 + random() % 5, 3);
    for (const Hierarchy kind : kinds) {
      const SphereTree<3> tree = tree_of<3>(kind, scene);
      const std::size_t least = Exhaustive<3>(tree, scene, false).least();
      EXPECT_EQ(smallest_family(tree, scene.asked).family, least) << scene.name;
      const std::size_t overlapping = Exhaustive<3>(tree, scene, true).least();
      EXPECT_LE(overlapping, least);
      smaller_with_overlap += overlapping < least ? 1 : 0;
      below_the_search += least < find_pairs(tree, scene.asked).family ? 1 : 0;
    }
  }
  EXPECT_GT(below_the_search, 20U);
  EXPECT_GT(smaller_with_overlap, 0U);  // the paper's families may be smaller, but rarely are
  EXPECT_LT(smaller_with_overlap, 10U);
}

TEST(ExplicitFamily, RefusesWhatTheTheoremDoesNotCover) {
  Random random(3);
  CollisionScene scene = connected_chain(random, 20, 3);
  const auto message = [&] {
    try {
      static_cast<void>(explicit_family(tree_of<3>(Hierarchy::wrapped, scene), scene.asked));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(message(), "none");
  const CollisionScene sound = scene;
  scene.asked.apart = 1;
  EXPECT_THAT(message(), HasSubstr("nonadjacent beads of one necklace"));
  scene = sound;
  scene.asked.necklaces = {{0, 9}, {10, 19}};
  EXPECT_THAT(message(), HasSubstr("nonadjacent beads of one necklace"));
  scene = sound;
  scene.centers.rightCols(8).array() += 50;
  EXPECT_THAT(message(), HasSubstr("beads 11 and 12 do not meet"));
}

TEST(BeadOrders, BySpaceCutEachNodeByAPlane) {
  Random random(9);
  Eigen::Matrix3Xd centers(3, 77);
  for (Eigen::Index b = 0; b < 77; ++b)
    centers.col(b) << std::round(uniform(random, -4, 4)), uniform(random, -3, 3), uniform(random, -2, 9);
  const std::vector<BeadId> order = order_by_space(centers);
  std::vector<BeadId> sorted = order;
  std::ranges::sort(sorted);
  for (BeadId b = 0; b < 77; ++b) EXPECT_EQ(sorted[b], b);
  const Eigen::Matrix3Xd ordered = in_order(centers, order);
  for (const std::vector<BeadRange>& nodes : depths_of(77))
    for (const BeadRange& node : nodes) {
      if (node.first == node.last) continue;
      const BeadId middle = node.first + (node.last - node.first) / 2;
      const Eigen::Index halves = middle - node.first + 1;
      const auto first = ordered.middleCols(node.first, halves);
      const auto second = ordered.middleCols(middle + 1, node.last - middle);
      const Eigen::Vector3d most = first.rowwise().maxCoeff(), least = second.rowwise().minCoeff();
      EXPECT_TRUE((most.array() <= least.array()).any()) << node.first << " " << node.last;
    }
}

/// The remark after Theorem 2.3: with antipodal points grouped first, all spheres of the layered hierarchy
/// are the sphere of all points.
TEST(BeadOrders, ByAntipodesMakeAllLayeredSpheresEqual) {
  for (const int h : {1, 3, 8}) {
    const Eigen::Matrix3Xd points = models::tightness_points(h);
    const auto n = static_cast<std::size_t>(points.cols());
    const Eigen::Matrix3Xd paired = in_order(points, order_by_antipodes(n));
    const std::array necklaces{BeadRange{0, static_cast<BeadId>(n - 1)}};
    LayeredHierarchy<2> layered(necklaces);
    layered.build(Balls<2>(paired, std::vector<double>(n, 0)));
    for (NodeId node = 0; node < layered.tree().node_count(); ++node)
      EXPECT_NEAR(layered.sphere(node).radius, 1, 1e-12);
  }
  EXPECT_THROW(static_cast<void>(order_by_antipodes(5)), std::invalid_argument);
}

}  // namespace
}  // namespace kds::separating_families_test
