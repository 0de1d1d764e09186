// Checks the error bounds stated in float_conversion.h over rationals.

#include "structures/blocks/float_conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "structures/collision/block_tree.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/rounds.h"

namespace kds::float_conversion_test {
namespace {

using namespace test;

struct Pair {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
};

/// Makes two balls that touch, or overlap by a rounding error, at the edge of a scene that two other balls
/// make wide. The floats there have their largest spacing, and both centres lie about half a spacing from a
/// float.
Pair touching_pair(Random& random) {
  Pair pair{Eigen::Matrix3Xd(3, 4), {0, 0, 0, 0}};
  pair.centers.col(2).setConstant(-1);
  pair.centers.col(3).setConstant(1);
  const double reach = std::exp2(uniform(random, -30, -1));
  Eigen::Vector3d direction(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  if (random() % 3 == 0) direction = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(random() % 3));
  direction.normalize();
  const double half_float = 0x1p-25 * (1 - 1e-6);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double sign = direction[axis] < 0 ? -1 : 1;
    const double edge = std::round(uniform(random, 0.5, 0.99) * 0x1p24) * 0x1p-24;
    // Rounding to floats moves the two centres apart by up to one spacing of floats.
    pair.centers(axis, 0) = sign * (edge - half_float);
    pair.centers(axis, 1) = pair.centers(axis, 0) + direction[axis] * reach;
  }
  pair.radii[0] = uniform(random, 0, 1) * reach;
  const double distance = (pair.centers.col(0) - pair.centers.col(1)).norm();
  pair.radii[1] = std::max(0.0, distance - pair.radii[0]);
  while (compare_distance(pair.centers.col(0), pair.centers.col(1), pair.radii[0], pair.radii[1]) > 0)
    pair.radii[1] = std::nextafter(pair.radii[1], 2.0);
  return pair;
}

/// Returns the coordinates of all beads in the conversion, rounded to floats; one row per axis.
std::array<std::vector<float>, 3> floats_in(const FloatConversion<3>& conversion, const Balls<3>& balls) {
  std::array<std::vector<double>, 3> copies;
  std::array<double*, 3> doubles{};
  std::array<const double*, 3> coordinates{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    copies[axis].resize((balls.size() + 15) / 16 * 16);
    std::copy_n(balls.coordinates(axis), balls.size(), copies[axis].begin());
    coordinates[axis] = doubles[axis] = copies[axis].data();
  }
  if (conversion.axes) turn_to_axes(conversion, coordinates, doubles, copies[0].size());
  std::array<std::vector<float>, 3> floats;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (BeadId b = 0; b < balls.size(); ++b)
      floats[axis].push_back(static_cast<float>(
          conversion.axes ? copies[axis][b] : copies[axis][b] * conversion.scale - conversion.shift[axis]));
  return floats;
}

TEST(FloatConversion, BallsThatTouchAreNearInFloats) {
  Random random(1);
  double tightest = 1, tightest_turned = 1;
  for (unsigned k = 0; k < rounds(100000U); ++k) {
    const Pair pair = touching_pair(random);
    const Balls<3> balls(pair.centers, pair.radii);
    std::optional<Axes<3>> axes;
    if (k % 2 == 1) axes = random_axes<3>(random);
    const FloatConversion<3> conversion = fit_float_conversion(scene_box(balls), 0, axes);
    const auto floats = floats_in(conversion, balls);
    const auto r = static_cast<float>(conversion.float_radius(pair.radii[0]));
    const auto s = static_cast<float>(conversion.float_radius(pair.radii[1]));
    float square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float f = floats[axis][0], g = floats[axis][1];
      ASSERT_LE(std::abs(f), conversion.bound);
      ASSERT_LE(f - r, g + s);
      ASSERT_LE(g - s, f + r);
      square += (f - g) * (f - g);
    }
    const float reach = r + s;
    ASSERT_LE(square, reach * reach);
    double& least = axes ? tightest_turned : tightest;
    least = std::min(least, 1 - static_cast<double>(std::sqrt(square) / reach));
  }
  EXPECT_LT(tightest, 0x1p-17);  // some cases come close to the bound
  EXPECT_LT(tightest_turned, 0x1p-16);
}

TEST(FloatConversion, CoordinatesErrByLessThanClaimed) {
  Random random(2);
  for (unsigned k = 0; k < rounds(3000U); ++k) {
    const CollisionScene scene = random_scene(random, 5);
    const Balls<3> balls(scene.centers, scene.radii);
    std::optional<Axes<3>> axes;
    if (k % 2 == 1) axes = random_axes<3>(random);
    const FloatConversion<3> conversion = fit_float_conversion(scene_box(balls), 0, axes);
    ASSERT_GE(conversion.bound, 0x1p-30);
    const auto floats = floats_in(conversion, balls);
    for (BeadId b = 0; b < balls.size(); ++b) {
      std::array<Rational, 3> exact;
      for (std::size_t axis = 0; axis < 3; ++axis)
        exact[axis] = Rational(balls.coordinate(b, axis)) * Rational(conversion.scale) -
                      Rational(conversion.shift[axis]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Rational along = exact[axis];
        if (axes) {
          along = 0;
          for (std::size_t j = 0; j < 3; ++j) along += Rational((*axes)[axis][j]) * exact[j];
        }
        const float f = floats[axis][b];
        ASSERT_LE(abs(Rational(f) - along),
                  Rational(0x1p-24) * Rational(1 + 0x1p-19) * Rational(conversion.bound))
            << scene.name;
        ASSERT_LE(std::abs(f), conversion.bound);
      }
      ASSERT_LT(balls.radius(b) * conversion.scale, 1.0);
    }
  }
}

TEST(FloatConversion, StrayedIsNoLessThanExactly) {
  Random random(3);
  for (unsigned k = 0; k < rounds(2000U); ++k) {
    const CollisionScene scene = random_scene(random, 40);
    BlockTree<3> tree(scene.asked);
    if (k % 2 == 1) tree.turn(random_axes<3>(random));
    (void)tree.pairs(Balls<3>(scene.centers, scene.radii));
    Eigen::Matrix3Xd moved = scene.centers;
    const double size = moved.cwiseAbs().maxCoeff() * std::exp2(uniform(random, -60, 1));
    for (Eigen::Index b = 0; b < moved.cols(); ++b)
      moved.col(b) +=
          size * Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    if (!moved.allFinite()) continue;
    Rational farthest = 0;
    for (Eigen::Index b = 0; b < moved.cols(); ++b) {
      Rational square = 0;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Rational d = Rational(moved(axis, b)) - Rational(scene.centers(axis, b));
        square += d * d;
      }
      farthest = std::max(farthest, square);
    }
    const double told = tree.strayed(Balls<3>(moved, scene.radii));
    if (std::isfinite(told)) {
      ASSERT_LE(farthest, Rational(told) * Rational(told)) << scene.name;
    }
    const double size_of_scene = scene.centers.cwiseAbs().maxCoeff();
    EXPECT_LE(tree.strayed(Balls<3>(scene.centers, scene.radii)),
              0x1p-18 * size_of_scene + 4 * std::numeric_limits<double>::denorm_min())
        << scene.name;
  }
}

}  // namespace
}  // namespace kds::float_conversion_test
