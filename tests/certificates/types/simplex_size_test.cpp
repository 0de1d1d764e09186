#include "certificates/types/simplex_size.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "certificates/search/predicate_searches.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/searches.h"

namespace kds::simplex_size_test {
namespace {

using test::second::Rational;

struct Simplex {
  Rational size;
  Rational last;  // the last bead's barycentric coordinate of the orthogonal sphere's centre
};

/// Solves the equations of the orthogonal sphere's centre by elimination. Returns nothing if the beads are
/// dependent.
template <std::size_t N, Motion M>
std::optional<Simplex> simplex_at(const M& motion, const Dyadic& time) {
  constexpr std::size_t m = N - 1;
  std::array<test::RationalPoint, m> edge;
  std::array<std::array<Rational, m + 1>, m> g;
  std::array<Rational, m> lift;
  const Rational weight = test::weight_at(motion, 0, time);
  for (std::size_t i = 0; i < m; ++i) {
    const auto bead = static_cast<BeadId>(i + 1);
    edge[i] = test::minus(test::point_at(motion, bead, time), test::point_at(motion, 0, time));
    lift[i] = test::dot(edge[i], edge[i]) - test::weight_at(motion, bead, time) + weight;
  }
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) g[i][j] = test::dot(edge[i], edge[j]);
    g[i][m] = lift[i] / 2;
  }
  for (std::size_t k = 0; k < m; ++k) {
    if (g[k][k] == 0) return std::nullopt;  // the Gram matrix is positive semidefinite
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Rational factor = g[i][k] / g[k][k];
      for (std::size_t j = k; j <= m; ++j) g[i][j] -= factor * g[k][j];
    }
  }
  Simplex simplex{-weight, g[m - 1][m] / g[m - 1][m - 1]};
  for (std::size_t i = 0; i < m; ++i) simplex.size += g[i][m] / g[i][i] * lift[i] / 2;
  return simplex;
}

template <std::size_t N, Motion M>
void expect_signs(unsigned seed) {
  test::Random random(seed);
  int compared = 0;
  for (int i = 0; i < 20; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<M>(random, N, kind);
      const Dyadic time = test::random_dyadic(random);
      const auto expected = simplex_at<N>(motion, time);
      if (!expected) continue;
      ++compared;
      std::array<BeadId, N> beads;
      for (BeadId b = 0; b < N; ++b) beads[b] = b;
      EXPECT_EQ(test::sign_at(SimplexSize<N>(beads, 1), motion, time), test::sign(expected->size));
      EXPECT_EQ(test::sign_at(SimplexSize<N>(beads, -1), motion, time), -test::sign(expected->size));
      const auto sides = centre_side_search<N>(MotionRef<M::dimension>(motion));
      EXPECT_EQ(sides->sign_at(CentreSide<N>{beads}, time), test::sign(expected->last));
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(SimplexSize, IsThatOfTheOrthogonalSphere) {
  expect_signs<2, BezierMotion<2, 1>>(1);
  expect_signs<3, BezierMotion<2, 1>>(2);
  expect_signs<2, BezierMotion<3, 3>>(3);
  expect_signs<3, BezierMotion<3, 1>>(4);
  expect_signs<4, BezierMotion<3, 1>>(5);
  expect_signs<4, BezierMotion<3, 3>>(6);
}

// Balls of radius 5 around (0, 0), (6, 0) and (3, h), where h falls from 16 to 0. The first two meet on the
// line x = 3 up to y = 4, and the third reaches the point (3, 4) when h = 9.
TEST(SimplexSize, VanishesWhenThreeBallsFirstMeet) {
  BezierMotion<3, 1> motion(3);
  for (int k = 0; k <= 1; ++k) {
    motion.set_coordinate(1, k, 0, 6);
    motion.set_coordinate(2, k, 0, 3);
    motion.set_coordinate(2, k, 1, k == 0 ? 16 : 0);
    for (BeadId b = 0; b < 3; ++b) motion.set_weight(b, k, 25);
  }
  for (const Kernel kernel : test::all_kernels) {
    StageCounts stages;
    const Failure meets = test::first_failure(kernel, SimplexSize<3>({2, 0, 1}, 1), motion, Instant(0.0),
                                              KnownAtStart::unknown, stages);
    ASSERT_EQ(meets.kind, Failure::Kind::later);
    EXPECT_LE(meets.time.lower, 7.0 / 16);
    EXPECT_GE(meets.time.upper, 7.0 / 16);
  }
}

TEST(SimplexSize, RefusesLiftedMotion) {
  const LiftedMotion<3> motion(4);
  EXPECT_THROW((void)search_over<SimplexSize<2>>(MotionRef<3>(motion)), std::invalid_argument);
}

}  // namespace
}  // namespace kds::simplex_size_test
