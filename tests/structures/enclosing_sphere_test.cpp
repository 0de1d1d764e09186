#include "structures/enclosing_sphere.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/support/exact_checks.h"
#include "tests/support/moving_beads.h"

namespace kds {
namespace {

using namespace test;

Eigen::Matrix3Xd columns(const Points& points) { return control_points(moving(points, points), 0); }
Basis first_beads(std::size_t size) {
  const std::array<BeadId, 4> beads{0, 1, 2, 3};
  return Basis(std::span(beads).first(size));
}

TEST(SphereOf, OneTwoThreeFourBeads) {
  const Eigen::Matrix3Xd centers = columns({{1, 2, 3}, {5, 2, 3}, {3, 4, 3}, {3, 2, 5}});
  for (const auto& sphere_from : {sphere_of, exact_sphere_of}) {
    EXPECT_EQ(sphere_from(first_beads(1), centers).center, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(sphere_from(first_beads(1), centers).radius, 0);
    for (std::size_t size = 2; size <= 4; ++size) {
      const Sphere sphere = sphere_from(first_beads(size), centers);
      EXPECT_NEAR((sphere.center - Eigen::Vector3d(3, 2, 3)).norm(), 0, 1e-14) << size;
      EXPECT_NEAR(sphere.radius, 2, 1e-14) << size;
    }
  }
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
    const Sphere sphere = exact_sphere_of(basis, columns(points));
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
    const Sphere sphere = exact_sphere_of(first_beads(2), columns({{0, 0, 0}, {6 * scale, 8 * scale, 0}}));
    EXPECT_DOUBLE_EQ(sphere.radius / scale, 5);
    EXPECT_DOUBLE_EQ(sphere.center.x() / scale, 3);
    EXPECT_DOUBLE_EQ(sphere.center.y() / scale, 4);
  }
}

TEST(LikelyBasis, IsRightInGeneralPosition) {
  std::mt19937 random(42);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int round = 0; round < 200; ++round) {
    Points points(2 + random() % 60);
    for (auto& p : points) {
      for (double& x : p) x = coordinate(random);
    }
    const auto last = static_cast<BeadId>(points.size() - 1);
    const Basis basis = likely_basis(0, last, first_beads(2), columns(points));
    const Space motion = moving(points, points);
    ASSERT_EQ(
        not_smallest_sphere(exact_points(motion, Dyadic(0.0)), 0, last, {basis.begin(), basis.end()}, true),
        std::nullopt);
  }
}

TEST(LikelyBasis, LooksAtItsBeadsOnly) {
  const Eigen::Matrix3Xd centers = columns({{100, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {-100, 0, 0}});
  const std::array<BeadId, 2> guess{1, 2};
  const Basis basis = likely_basis(1, 3, Basis(guess), centers);
  EXPECT_THAT(std::vector(basis.begin(), basis.end()), testing::ElementsAre(1, 3));
}

TEST(LikelyBasis, GivesSomeBasisOfAnything) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  for (const Points& points :
       {Points(5, {1, 1, 1}), Points{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}},
        Points(5, {1e300, -1e300, 1e300}), Points{{0, 0, 0}, {1e308, 0, 0}, {-1e308, 0, 0}},
        Points{{0, 0, 0}, {nan, 0, 0}, {1, 1, 1}, {infinity, 0, 0}},
        Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}}) {
    const auto last = static_cast<BeadId>(points.size() - 1);
    const Basis basis = likely_basis(0, last, first_beads(2), columns(points));
    EXPECT_GE(basis.size, 1);
    EXPECT_LE(basis.size, 4);
    for (const BeadId b : basis) EXPECT_LE(b, last);
    EXPECT_TRUE(std::is_sorted(basis.begin(), basis.end()));
  }
}

}  // namespace
}  // namespace kds
