// Compares near pairs with all pairs.

#include "motions/scene/near_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "motions/numbers/exact_number.h"

namespace kds::near_pairs_test {
namespace {

using Pairs = std::set<std::pair<BeadId, BeadId>>;

struct Balls {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
};

Balls balls(const std::vector<Eigen::Vector4d>& numbers) {
  Balls result{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(numbers.size())), {}};
  for (const Eigen::Vector4d& ball : numbers) {
    result.centers.col(static_cast<Eigen::Index>(result.radii.size())) = ball.head<3>();
    result.radii.push_back(ball[3]);
  }
  return result;
}

bool meet(const Balls& balls, BeadId i, BeadId j) {
  Rational square = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational x =
        Rational(balls.centers(axis, Eigen::Index{i})) - Rational(balls.centers(axis, Eigen::Index{j}));
    square += x * x;
  }
  const Rational reach = Rational(balls.radii[i]) + Rational(balls.radii[j]);
  return square <= reach * reach;
}

// Checks that each pair is visited at most once, in order, and that no pair that meets is missing. Returns
// the number of visited pairs.
std::size_t check(const Balls& balls) {
  Pairs visited;
  visit_near_pairs(balls.centers, balls.radii, [&](BeadId i, BeadId j) {
    EXPECT_LT(i, j);
    EXPECT_TRUE(visited.emplace(i, j).second) << i << " " << j;
  });
  for (BeadId j = 0; j < balls.radii.size(); ++j)
    for (BeadId i = 0; i < j; ++i)
      EXPECT_TRUE(visited.contains({i, j}) || !meet(balls, i, j)) << i << " " << j;
  return visited.size();
}

TEST(NearPairs, OfRandomBallsOfManySizes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-10, 10), power(-8, 2);
  for (int round = 0; round < 30; ++round) {
    std::vector<Eigen::Vector4d> numbers;
    for (int i = 0; i < 80; ++i) {
      const double radius = round % 3 == 0 ? 1 : i % 10 == 0 ? 0 : std::exp2(power(random));
      numbers.emplace_back(place(random), place(random), round % 2 == 0 ? place(random) : 0, radius);
    }
    check(balls(numbers));
  }
}

TEST(NearPairs, OfTiesOnTheGrid) {
  std::vector<Eigen::Vector4d> numbers;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      // These balls touch each other and lie on cell walls.
      for (int z = -2; z <= 2; ++z) numbers.emplace_back(x, y, z, 0.5);
  check(balls(numbers));
  for (auto& ball : numbers) ball.head<3>() *= std::nextafter(1.0, 2.0);
  check(balls(numbers));
  for (auto& ball : numbers) ball.head<3>() = ball.head<3>().array() - 0x1p-60;  // slightly below the walls
  check(balls(numbers));
}

TEST(NearPairs, AtExtremes) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  check(balls({}));
  check(balls({{0, 0, 0, 0}}));
  check(balls({{1, 2, 3, 0}, {1, 2, 3, 0}, {1, 2, 3, 5}}));
  check(balls({{0, 0, 0, tiny}, {-tiny, 0, 0, tiny}, {tiny, -tiny, tiny, 0}, {3 * tiny, 0, 0, tiny}}));
  check(balls({{-tiny, 0, 0, 1}, {1, 0, 0, 0.5}, {0, -tiny, 2, 1}}));
  check(balls({{1e308, 0, 0, 1e-300}, {1e308, 0, 0, 1e-300}, {-1e308, 0, 0, 1e308}, {0, 1e308, 0, 1}}));
  check(balls({{0x1p60, 1, 1, 1}, {0x1p60 + 256, 1, 1, 200}, {0, 0, 0, 1}, {1, 1, 1, 1}}));
  check(balls({{0x1p52, 0, 0, 0.5}, {0x1p52 - 1, 0, 0, 0.5}, {0x1p52 + 1, 0, 0, 0.5}}));
}

TEST(NearPairs, AreFewWhereBallsAreSpread) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 100);
  std::vector<Eigen::Vector4d> numbers;  // 20000 balls of volume 4.2 in a volume of 1e6
  for (int i = 0; i < 20000; ++i) numbers.emplace_back(place(random), place(random), place(random), 1);
  const Balls spread = balls(numbers);
  std::size_t visited = 0;
  visit_near_pairs(spread.centers, spread.radii, [&](BeadId, BeadId) { ++visited; });
  EXPECT_LT(visited, 20000U * 20);
}

}  // namespace
}  // namespace kds::near_pairs_test
