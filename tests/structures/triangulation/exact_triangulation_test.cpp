// Compares static triangulations of exact positions with CGAL over rationals without a filter, for regular,
// nearly regular and arbitrary positions. Compares the power tests in them with the determinant by its
// definition.

#include "structures/triangulation/exact_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/support/judges/cgal_triangulation.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::exact_triangulation_test {
namespace {

using namespace test;

/// Computes the determinant by its definition, as a sum over all permutations of the columns.
template <std::size_t N>
Integer determinant(const std::array<std::array<Integer, N>, N>& rows) {
  std::array<std::size_t, N> column{};
  std::iota(column.begin(), column.end(), std::size_t{0});
  Integer sum = 0;
  do {
    Integer product = 1;
    for (std::size_t i = 0; i < N; ++i) {
      product *= rows[i][column[i]];
      for (std::size_t j = i + 1; j < N; ++j)
        if (column[i] > column[j]) product = -product;
    }
    sum += product;
  } while (std::next_permutation(column.begin(), column.end()));
  return sum;
}

template <int Dimension>
void expect_sign_of_determinant(std::mt19937_64& random, unsigned bits, int& zeros) {
  constexpr std::size_t count = Dimension + 2;
  std::array<std::array<Integer, Dimension + 1>, count> numbers;
  for (auto& point : numbers) {
    for (Integer& x : point) {
      x = static_cast<std::int64_t>(random() % 3) - 1;  // on a lattice, where points are often cospherical
      if (bits > 0) x = (x << bits) + static_cast<std::int64_t>(random() % 3);
    }
  }
  std::array<WholePoint<Dimension>, count> points{};
  std::array<std::array<Integer, Dimension + 1>, Dimension + 1> rows;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k <= Dimension; ++k) points[i][k] = numbers[i][k].get_mpz_t();
    if (i + 1 == count) break;
    rows[i][Dimension] = numbers.back()[Dimension] - numbers[i][Dimension];
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      rows[i][axis] = numbers[i][axis] - numbers.back()[axis];
      rows[i][Dimension] += rows[i][axis] * rows[i][axis];
    }
  }
  WholePowerTest<Dimension> test;
  const int sign = sgn(determinant(rows));
  EXPECT_EQ(test.sign(points), sign);
  EXPECT_EQ(test.sign(points), sign);  // reuses the memory of the call before
  std::swap(points[0], points[1]);
  EXPECT_EQ(test.sign(points), -sign);
  zeros += sign == 0 ? 1 : 0;
}

TEST(WholePowerTest, IsTheDeterminant) {
  for (const unsigned bits : {0U, 40U, 300U}) {
    std::mt19937_64 random(bits);
    int zeros = 0;
    for (int round = 0; round < 300 && !HasFailure(); ++round) {
      SCOPED_TRACE("round " + std::to_string(round) + " of " + std::to_string(bits) + " bits");
      expect_sign_of_determinant<2>(random, bits, zeros);
      expect_sign_of_determinant<3>(random, bits, zeros);
    }
    EXPECT_TRUE(bits > 0 || zeros > 50) << zeros;
  }
}

/// Makes lattice points that are moved by up to `most` times 2^-bits, and turned so that all coordinates are
/// long.
std::vector<ExactPoint> near_lattice(std::mt19937_64& random, int most, unsigned bits) {
  const auto moved = [&](int x) {
    const auto by = static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * most + 1)) - most;
    return Dyadic((Integer(x) << bits) + by, bits).rational();
  };
  std::vector<ExactPoint> points;
  for (int b = 0; b < 36; ++b) {
    const Rational x = moved(b % 3), y = moved(b / 3 % 3), z = moved(b / 9);
    const Rational weight(b % 5 == 0 ? 3 : 2);
    points.push_back(
        {Rational(12) * x - Rational(5) * y, Rational(5) * x + Rational(12) * y, Rational(13) * z, weight});
  }
  return points;
}

std::vector<ExactBead> beads_of(const std::vector<ExactPoint>& points) {
  std::vector<ExactBead> beads;
  for (const ExactPoint& p : points) beads.push_back({{p[0], p[1], p[2]}, p[3]});
  return beads;
}

TEST(ExactTriangulation, IsRightOnLatticesAndNearThem) {
  for (const unsigned bits : {2U, 30U, 120U}) {
    for (const int most : {0, 1, 1000}) {
      SCOPED_TRACE(std::to_string(most) + " / 2^" + std::to_string(bits));
      std::mt19937_64 random(bits);
      const auto points = near_lattice(random, most, bits);
      const auto built = static_triangulation<3>(beads_of(points), false);
      EXPECT_EQ(not_regular(points, built.cells), std::nullopt);
      const CgalCells cgal = cgal_regular_cells(points);
      EXPECT_EQ(points.size() - built.hidden.size(), cgal.visible);
      if (most == 1000) {
        EXPECT_EQ(built.cells, cgal.cells);  // in general position the triangulation is unique
      }
    }
  }
}

TEST(ExactTriangulation, IsRightInThePlane) {
  std::mt19937_64 random(7);
  for (const int most : {0, 1}) {
    auto points = near_lattice(random, most, 60);
    points.resize(9);
    for (ExactPoint& p : points) p[2] = Rational(0);
    const auto built = static_triangulation<2>(beads_of(points), true);
    EXPECT_EQ(built.dimension, 2);
    EXPECT_TRUE(built.hidden.empty());
    EXPECT_EQ(built.cells.size(), 2 * points.size() - 2);  // with the infinite cells the hull is a sphere
  }
}

}  // namespace
}  // namespace kds::exact_triangulation_test
