#include "structures/collision/box_tree.h"

#include <gtest/gtest.h>

#include "motions/numbers/exact_number.h"
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

/// Checks that the slabs of each node hold its balls.
template <int Dimension>
void check(const Balls<Dimension>& balls, std::span<const BeadRange> necklaces, int directions) {
  BoxTree<Dimension> tree(necklaces, directions);
  tree.build(balls);
  for (std::uint32_t node = 0; node < tree.nodes().size(); ++node)
    for (std::size_t k = 0; k < tree.directions().size(); ++k)
      for (BeadId b = tree.nodes()[node].first; b <= tree.nodes()[node].last; ++b)
        EXPECT_TRUE((holds<Dimension>(tree.slabs(node)[k], tree.directions()[k], balls, b)));
}

template <int Dimension>
void try_random_scenes(unsigned seed) {
  Random random(seed);
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
    const std::vector<BeadRange> necklaces = some_pairs(random, beads).necklaces;
    for (const int directions : box_direction_counts<Dimension>()) check(balls, necklaces, directions);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(BoxTree, HoldsItsBallsInThePlane) { try_random_scenes<2>(51); }
TEST(BoxTree, HoldsItsBallsInSpace) { try_random_scenes<3>(52); }

TEST(BoxTree, OverflowsToUnboundedSlabs) {
  Eigen::Matrix3Xd centers(3, 3);
  centers << 1.7e308, -1.7e308, 1, 1.7e308, 1.7e308, 2, -1.7e308, 0, 3;
  const std::vector<double> radii{1e308, 1, 1};
  const std::vector<BeadRange> necklaces{{0, 2}};
  for (const int directions : {3, 13}) check(Balls<3>(centers, radii), necklaces, directions);
}

}  // namespace
}  // namespace kds::box_tree_test
