#include "certificates/types/power_test.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/rounds.h"
#include "tests/support/searches.h"

namespace kds::power_test_test {
namespace {

using test::identity_with;

using Points = std::vector<std::array<double, 3>>;

int power_test(const Points& points, const std::vector<double>& weights = {}) {
  return test::sign_at(PowerTest<3>({0, 1, 2, 3, 4}, 1), test::at_rest(points, weights), Dyadic(0.0));
}

// A positively oriented cell whose sphere has the centre (1/2, 1/2, 1/2).
const Points corner{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Points with(const std::array<double, 3>& t) {
  Points points = corner;
  points.push_back(t);
  return points;
}

TEST(PowerTest, IsPositiveOutside) {
  EXPECT_EQ(power_test(with({9, 9, 9})), 1);
  EXPECT_EQ(power_test(with({-9, 0, 0})), 1);
  EXPECT_EQ(power_test(with({0.5, 0.5, 0.5})), -1);
  Points turned = with({9, 9, 9});
  std::swap(turned[0], turned[1]);
  EXPECT_EQ(power_test(turned), -1);
}

TEST(PowerTest, VanishesOnTheSphere) {
  EXPECT_EQ(power_test(with({1, 1, 1})), 0);
  EXPECT_EQ(power_test(with({1, 1, 0})), 0);
  EXPECT_EQ(power_test(with({0, 0, 1})), 0);  // a bead of the cell itself
  EXPECT_EQ(power_test(with({1, 1, std::nextafter(1.0, 2)})), 1);
  EXPECT_EQ(power_test(with({1, 1, std::nextafter(1.0, 0)})), -1);
  // All beads are in one plane.
  EXPECT_EQ(power_test({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0}}), 0);
}

TEST(PowerTest, HeavyBeadsReachIn) {
  EXPECT_EQ(power_test(with({2, 2, 2}), {0, 0, 0, 0, 1}), 1);
  EXPECT_EQ(power_test(with({2, 2, 2}), {0, 0, 0, 0, 6}), 0);  // the power to the sphere is 27/4 - 3/4
  EXPECT_EQ(power_test(with({2, 2, 2}), {0, 0, 0, 0, 6.1}), -1);
  EXPECT_EQ(power_test(with({1, 1, 1}), {0, 0, 0, 0, -0.1}), 1);
  EXPECT_EQ(power_test(with({1, 1, 1}), {5, 5, 5, 5, 5}), 0);  // only differences of weights matter
  EXPECT_EQ(power_test(with({0, 0, 0}), {1, 0, 0, 0, 0}), 1);  // the lighter of two coincident beads
  EXPECT_EQ(power_test(with({0, 0, 0}), {0, 0, 0, 0, 1}), -1);
}

TEST(PowerTest, IsAntisymmetric) {
  test::Random random(711);
  for (int i = 0; i < 5; ++i) {
    const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 5, test::MotionKind::generic);
    const Dyadic time = test::random_dyadic(random);
    std::array<BeadId, 5> order{0, 1, 2, 3, 4};
    const int first = test::sign_at(PowerTest<3>(order, 1), motion, time);
    ASSERT_NE(first, 0);
    do {
      int inversions = 0;
      for (std::size_t a = 0; a < 5; ++a) {
        for (std::size_t b = a + 1; b < 5; ++b) inversions += order[a] > order[b];
      }
      const int sign = inversions % 2 == 0 ? 1 : -1;
      EXPECT_EQ(test::sign_at(PowerTest<3>(order, 1), motion, time), sign * first);
      EXPECT_EQ(test::sign_at(PowerTest<3>(order, -1), motion, time), -sign * first);
      EXPECT_EQ(PowerTest<3>(order, 1).identity(), PowerTest<3>({0, 1, 2, 3, 4}, 1).identity());
      EXPECT_EQ(test::exact_function(PowerTest<3>(order, sign), motion).scaled(),
                test::exact_function(PowerTest<3>({0, 1, 2, 3, 4}, 1), motion).scaled());
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

// Compares with the sphere orthogonal to four balls, computed by elimination, and with the determinant of
// absolute coordinates.
TEST(PowerTest, IsThePowerToTheOrthogonalSphere) {
  test::Random random(712);
  int proper = 0;
  for (int i = 0; i < test::rounds(40); ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<BezierMotion<3, 2>>(random, 5, kind);
      const Dyadic time = test::random_dyadic(random);
      SCOPED_TRACE("seed 712, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      test::Matrix rows;
      for (BeadId b = 0; b < 5; ++b) {
        const auto p = test::point_at(motion, b, time);
        rows.push_back({p[0], p[1], p[2], test::dot(p, p) - test::weight_at(motion, b, time), 1});
      }
      const PowerTest<3> certificate({0, 1, 2, 3, 4}, 1);
      const int found = test::sign_at(certificate, motion, time);
      EXPECT_EQ(found, test::sign(test::determinant_of(rows)));
      EXPECT_EQ(found, test::exact_function(certificate, motion).sign_at(time));

      // |x|^2 - w = 2 c.x + k for the four balls; a larger value means outside.
      test::Matrix m;
      std::vector<test::second::Rational> right;
      test::Matrix orientation;
      for (std::size_t b = 0; b < 4; ++b) {
        m.push_back({2 * rows[b][0], 2 * rows[b][1], 2 * rows[b][2], 1});
        right.push_back(rows[b][3]);
        orientation.push_back({1, rows[b][0], rows[b][1], rows[b][2]});
      }
      const auto sphere = test::solve(m, right);
      if (!sphere) continue;
      ++proper;
      test::second::Rational power = rows[4][3] - (*sphere)[3];
      for (std::size_t axis = 0; axis < 3; ++axis) power -= 2 * (*sphere)[axis] * rows[4][axis];
      EXPECT_EQ(found, test::sign(test::determinant_of(orientation)) * test::sign(power));
    }
  }
  EXPECT_GT(proper, test::rounds(150));
}

TEST(PowerTest, HasAnIdentityByType) {
  const Identity identity = PowerTest<3>({7, 3, 9, 1, 4}, -1).identity();
  EXPECT_EQ(identity.type, PowerTest<3>::type.number);
  EXPECT_EQ(identity.beads, identity_with(0, {1, 3, 4, 7, 9}).beads);
  EXPECT_LT(PowerTest<3>({0, 1, 2, 3, 4}, 1).identity(), PowerTest<3>({0, 1, 2, 3, 5}, 1).identity());
}

TEST(SortBeads, TellsTheSignOfThePermutation) {
  std::array<BeadId, 5> beads{4, 3, 2, 1, 0};
  EXPECT_EQ(sort_beads(beads), 1);  // two exchanges
  EXPECT_EQ(beads, (std::array<BeadId, 5>{0, 1, 2, 3, 4}));
  EXPECT_EQ(sort_beads(beads), 1);
  beads = {1, 0, 2, 3, 4};
  EXPECT_EQ(sort_beads(beads), -1);
  std::array<BeadId, 3> cycle{1, 2, 0};
  EXPECT_EQ(sort_beads(cycle), 1);
}

TEST(SortBeads, BringsTheLastToItsPlace) {
  for (BeadId last = 0; last <= 8; last += 2) {
    std::array<BeadId, 5> beads{1, 3, 5, 7, last};
    std::array<BeadId, 5> all = beads;
    EXPECT_EQ(sort_last_bead(beads), sort_beads(all)) << last;
    EXPECT_EQ(beads, all);
  }
}

}  // namespace
}  // namespace kds::power_test_test
