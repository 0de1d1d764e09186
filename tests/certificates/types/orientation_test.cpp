#include "certificates/types/orientation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/searches.h"

namespace kds::orientation_test {
namespace {

using test::identity_with;

using Points = std::vector<std::array<double, 3>>;

int orientation(const Points& points, std::array<BeadId, 4> order = {0, 1, 2, 3}, int wanted = 1) {
  return test::sign_at(Orientation<3>(order, wanted), test::at_rest(points), Dyadic(0.0));
}

TEST(Orientation, IsPositiveForTheAxes) {
  EXPECT_EQ(orientation({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1);
  EXPECT_EQ(orientation({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}), -1);
  EXPECT_EQ(orientation({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {0, 1, 2, 3}, -1), 1);
}

TEST(Orientation, VanishesOnPlanes) {
  EXPECT_EQ(orientation({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0}}), 0);
  EXPECT_EQ(orientation({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.25, 0.25}}), 0);
  EXPECT_EQ(orientation({{1, 2, 3}, {2, 4, 6}, {3, 6, 9}, {0, 1, 0}}), 0);  // three beads on a line
  EXPECT_EQ(orientation({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, {4, 4, 1}}), 0);  // two coincident beads
  EXPECT_NE(orientation({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 7, 0x1p-1074}}), 0);
}

TEST(Orientation, IsAntisymmetric) {
  test::Random random(701);
  for (int i = 0; i < 20; ++i) {
    const auto motion = test::random_motion<BezierMotion<3, 2>>(random, 4, test::MotionKind::generic);
    const Dyadic time = test::random_dyadic(random);
    std::array<BeadId, 4> order{0, 1, 2, 3};
    const int first = test::sign_at(Orientation<3>(order, 1), motion, time);
    do {
      int inversions = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) inversions += order[a] > order[b];
      }
      const int sign = inversions % 2 == 0 ? 1 : -1;
      EXPECT_EQ(test::sign_at(Orientation<3>(order, 1), motion, time), sign * first);
      EXPECT_EQ(test::sign_at(Orientation<3>(order, -1), motion, time), -sign * first);
      // one function for all orders, equal to the last bit
      EXPECT_EQ(Orientation<3>(order, 1).identity(), Orientation<3>({0, 1, 2, 3}, 1).identity());
      const auto function = test::exact_function(Orientation<3>(order, sign), motion);
      EXPECT_EQ(function.scaled(), test::exact_function(Orientation<3>({0, 1, 2, 3}, 1), motion).scaled());
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(Orientation, IsTheDeterminant) {
  test::Random random(702);
  for (int i = 0; i < 60; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<BezierMotion<3, 3>>(random, 4, kind);
      const Dyadic time = test::random_dyadic(random);
      test::Matrix rows;
      for (BeadId b = 0; b < 4; ++b) {
        const auto p = test::point_at(motion, b, time);
        rows.push_back({1, p[0], p[1], p[2]});
      }
      const Orientation<3> certificate({0, 1, 2, 3}, 1);
      const int expected = test::sign(test::determinant_of(rows));
      EXPECT_EQ(test::sign_at(certificate, motion, time), expected) << "seed 702, round " << i;
      EXPECT_EQ(test::exact_function(certificate, motion).sign_at(time), expected) << "seed 702, round " << i;
    }
  }
}

TEST(Orientation, HasAnIdentityByType) {
  const Identity identity = Orientation<3>({7, 3, 9, 1}, -1).identity();
  EXPECT_EQ(identity.type, Orientation<3>::type.number);
  EXPECT_EQ(identity.beads, identity_with(0, {1, 3, 7, 9}).beads);
  EXPECT_NE(identity, Orientation<3>({7, 3, 8, 1}, -1).identity());
}

}  // namespace
}  // namespace kds::orientation_test
