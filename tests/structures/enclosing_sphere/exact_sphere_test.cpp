#include "structures/enclosing_sphere/exact_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::exact_sphere_test {
namespace {

using namespace test;

Balls<3> balls_of(const Points& points, double radius = 0) {
  return Balls<3>(control_points(moving(points, points), 0), std::vector<double>(points.size(), radius));
}
Basis first_beads(std::size_t size) {
  const std::array<BeadId, 4> beads{0, 1, 2, 3};
  return Basis(std::span(beads).first(size));
}

TEST(ExactSphereOf, OneTwoThreeFourBeads) {
  for (const double r : {0.0, 0.5}) {
    const Balls<3> balls = balls_of({{1, 2, 3}, {5, 2, 3}, {3, 4, 3}, {3, 2, 5}}, r);
    EXPECT_EQ(exact_sphere_of(first_beads(1), balls).center, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(exact_sphere_of(first_beads(1), balls).radius, r);
    for (std::size_t size = 2; size <= 4; ++size) {
      const Sphere sphere = exact_sphere_of(first_beads(size), balls);
      EXPECT_EQ(sphere.center, Eigen::Vector3d(3, 2, 3)) << size;
      EXPECT_EQ(sphere.radius, 2 + r) << size;
    }
  }
}

TEST(ExactSphereOf, BallsOfTwoSizesInThePlane) {
  Eigen::Matrix3Xd centers(3, 2);
  centers << 0, 10, 0, 0, 0, 0;
  const Balls<2> balls(centers, std::vector<double>{1, 3});
  const Sphere sphere = exact_sphere_of(first_beads(2), balls);
  EXPECT_EQ(sphere.center, Eigen::Vector3d(6, 0, 0));
  EXPECT_EQ(sphere.radius, 7);
  const std::vector<double> swallowed{1, 20};
  // One ball is superfluous.
  const Sphere larger = exact_sphere_of(first_beads(2), Balls<2>(centers, swallowed));
  EXPECT_EQ(larger.center, Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(larger.radius, 20);
}

TEST(ExactSphereOf, IsRoundedOnceACoordinate) {
  std::mt19937 random(41);
  for (int round = 0; round < 500; ++round) {
    const std::size_t size = 1 + random() % 4;
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 600) - 300);
    Points points = random_grid_points(random, size, 50);
    for (auto& p : points) {
      for (double& x : p) x = (x / 7 + 0.1) * scale;
    }
    if (round % 3 == 0 && size == 4) points[3] = {points[0][0], points[0][1], points[0][2] * (1 + 0x1p-40)};
    const Space motion = moving(points, points);
    const Basis basis = first_beads(size);
    const auto exact = sphere_through(exact_points(motion, Dyadic(0.0)), {basis.begin(), basis.end()});
    if (!exact) continue;
    const Sphere sphere = exact_sphere_of(basis, balls_of(points));
    const auto off = [](double rounded, const Rational& value) {
      return Rational(abs(Rational(rounded) - value));
    };
    for (int axis = 0; axis < 3; ++axis) {
      const Rational& value = exact->first.center[static_cast<std::size_t>(axis)];
      ASSERT_LE(off(sphere.center[axis], value), abs(value) * Rational(0x1p-52));
    }
    const Rational square = Rational(sphere.radius) * Rational(sphere.radius);
    ASSERT_LE(Rational(abs(square - exact->first.square)), exact->first.square * Rational(0x1p-50));
  }
}

TEST(ExactSphereOf, SquaresMayLeaveTheRangeOfDouble) {
  for (const double scale : {1e-200, 1e-300, 1e200, 1e300}) {
    const Sphere sphere = exact_sphere_of(first_beads(2), balls_of({{0, 0, 0}, {6 * scale, 8 * scale, 0}}));
    EXPECT_DOUBLE_EQ(sphere.radius / scale, 5);
    EXPECT_DOUBLE_EQ(sphere.center.x() / scale, 3);
    EXPECT_DOUBLE_EQ(sphere.center.y() / scale, 4);
  }
}

}  // namespace
}  // namespace kds::exact_sphere_test
