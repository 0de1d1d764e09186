#include "structures/collision/box_tree.h"

#include <gtest/gtest.h>

#include "motions/numbers/exact_number.h"
#include "structures/collision/brute_force.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/hierarchy/box_hierarchy.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/text_of.h"

namespace kds::box_tree_test {
namespace {

using namespace test;

/// Returns whether the slab holds the ball, decided on rationals.
template <int Dimension>
bool holds(const typename BoxTree<Dimension>::Slab& slab, const SlabDirection& direction,
           const Balls<Dimension>& balls, BeadId bead) {
  if (std::isinf(slab.low) && std::isinf(slab.high)) return true;
  Rational along = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    along += direction.steps[axis] * Rational(balls.coordinate(bead, axis));
  const Rational radius = balls.radius(bead), square = direction.square() * radius * radius;
  const Rational above = Rational(slab.high) - along, below = along - Rational(slab.low);
  return above >= 0 && below >= 0 && above * above >= square && below * below >= square;
}

/// Checks slabs, family and pairs by brute force. Returns the size of the family.
template <int Dimension>
std::size_t check(const Balls<Dimension>& balls, const PairsAsked& asked, double distance, int directions) {
  BoxTree<Dimension> tree(asked.necklaces, directions);
  tree.build(balls);
  for (std::uint32_t node = 0; node < tree.nodes().size(); ++node)
    for (std::size_t k = 0; k < tree.directions().size(); ++k)
      for (BeadId b = tree.nodes()[node].first; b <= tree.nodes()[node].last; ++b)
        EXPECT_TRUE((holds<Dimension>(tree.slabs(node)[k], tree.directions()[k], balls, b)));
  std::vector<SeparatingFamily::Pair> family;
  const PairsFound found = find_pairs(tree, balls, asked, distance, &family);
  EXPECT_EQ(found.pairs, pairs_by_force(balls, asked, distance));
  EXPECT_EQ(found.family, family.size());
  std::vector<BeadPair> covered = found.pairs;
  for (const auto& [first, second] : family) {
    const TreeBox &a = tree.nodes()[first], &b = tree.nodes()[second];
    EXPECT_TRUE(tree.are_apart(first, second, distance) || (a.is_bead() && b.is_bead()));
    for (BeadId i = a.first; i <= a.last; ++i)
      for (BeadId j = b.first; j <= b.last; ++j)
        if (asked.asks({i, j})) covered.push_back({i, j});
  }
  std::sort(covered.begin(), covered.end());
  std::vector<BeadPair> all;
  for (BeadId i = 0; i < balls.size(); ++i)
    for (BeadId j = i + 1; j < balls.size(); ++j)
      if (asked.asks({i, j})) all.push_back({i, j});
  EXPECT_EQ(covered, all);
  return family.size();
}

template <int Dimension>
void try_random_scenes(unsigned seed) {
  Random random(seed);
  std::size_t fewer = 0;
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(text_of("round ", round));
    const std::size_t beads = 1 + random() % 30;
    const double grid = round % 3 == 0 ? 1 : 0, size = round % 5 == 0 ? 0x1p300 : 1;
    Eigen::Matrix3Xd centers(3, static_cast<Eigen::Index>(beads));
    std::vector<double> radii;
    for (std::size_t b = 0; b < beads; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        const double x = uniform(random, -4, 4);
        centers(axis, static_cast<Eigen::Index>(b)) = size * (grid > 0 ? std::round(x) : x);
      }
      radii.push_back(size * (grid > 0 ? 0.5 : uniform(random, 0, 0.7)));
    }
    const Balls<Dimension> balls(centers, radii);
    const PairsAsked asked = some_pairs(random, beads);
    const double distance = round % 2 == 0 ? 0 : size * (grid > 0 ? 1 : 0.7);
    std::size_t before = 0;
    for (const int directions : box_direction_counts<Dimension>()) {
      const std::size_t pairs = check(balls, asked, distance, directions);
      if (before > 0) {
        EXPECT_LE(pairs, before);  // more directions separate more pairs
        fewer += pairs < before ? 1 : 0;
      }
      before = pairs;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(fewer, 0U);
}

TEST(BoxTree, SeparatesInThePlane) { try_random_scenes<2>(51); }
TEST(BoxTree, SeparatesInSpace) { try_random_scenes<3>(52); }

TEST(BoxTree, ThatOverflowsProvesNothing) {
  Eigen::Matrix3Xd centers(3, 3);
  centers << 1.7e308, -1.7e308, 1, 1.7e308, 1.7e308, 2, -1.7e308, 0, 3;
  const std::vector<double> radii{1e308, 1, 1};
  const PairsAsked asked{{{0, 2}}, true, 1, true, {}};
  for (const int directions : {3, 13})
    for (const double distance : {0.0, 1e308}) check(Balls<3>(centers, radii), asked, distance, directions);
}

}  // namespace
}  // namespace kds::box_tree_test
