// Pairs of balls by nearest images, judged by all images within a box of shifts. All numbers are multiples of
// 1/4, so that squares are exact in doubles, and gaps are 0 or far from it.

#include "structures/images/image_pairs.h"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "motions/base/input_error.h"
#include "tests/support/inputs/random_cells.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::image_pairs_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

double least_square(const Eigen::Matrix3Xd& centers, const Cell& cell, BeadId a, BeadId b) {
  constexpr int most = 9;
  double least = HUGE_VAL;
  for (int i = -most; i <= most; ++i)
    for (int j = -most; j <= most; ++j)
      for (int k = -most; k <= most; ++k)
        least = std::min(least,
                         (centers.col(b) - centers.col(a) + cell * Eigen::Vector3d(i, j, k)).squaredNorm());
  return least;
}

template <int D>
void expect_right(CellKind kind, Random& random) {
  const Cell cell = random_cell(random, kind, D);
  constexpr BeadId beads = 9;
  Eigen::Matrix3Xd centers(3, beads);
  for (double& x : centers.reshaped()) x = 0.25 * pick(random, -24, 24);
  if (D == 2) centers.row(2).setZero();
  std::vector<double> radii;
  for (BeadId b = 0; b < beads; ++b) radii.push_back(0.25 * pick(random, 0, 4));
  const Balls<D> balls(centers, radii);
  const PairsAsked asked{{{0, 4}, {5, 8}}};
  std::optional<BeadPair> closest;
  double gap = HUGE_VAL;
  for (const double distance : {0.0, 0.25, 1.0, 2.5, 7.0}) {
    std::vector<BeadPair> right;
    for (BeadId a = 0; a < beads; ++a)
      for (BeadId b = a + 1; b < beads; ++b) {
        if (!asked.asks({a, b})) continue;
        const double square = least_square(centers, cell, a, b), reach = radii[a] + radii[b];
        if (square <= (reach + distance) * (reach + distance)) right.push_back({a, b});
        if (std::sqrt(square) - reach >= gap) continue;
        gap = std::sqrt(square) - reach;
        closest = BeadPair{a, b};
      }
    EXPECT_EQ(image_pairs_by_force(balls, cell, asked, distance), right);
    EXPECT_EQ(image_pairs_by_cells(balls, cell, asked, distance), right);
  }
  const auto found = closest_images_by_force(balls, cell, asked);
  ASSERT_TRUE(found);
  EXPECT_EQ((BeadPair{found->first, found->second}), *closest);
  EXPECT_NEAR(found->distance, gap, 1e-12);
  EXPECT_EQ(found->sign, gap > 0 ? 1 : gap < 0 ? -1 : 0);
  const auto by_cells = closest_images_by_cells(balls, cell, asked);
  ASSERT_TRUE(by_cells);
  EXPECT_EQ((BeadPair{by_cells->first, by_cells->second}), *closest);
  EXPECT_EQ(by_cells->distance, found->distance);
}

TEST(ImagePairs, AgreeWithAllImages) {
  Random random(54);
  for (int round = 0; round < rounds(20, 2); ++round) {
    for (const CellKind kind : cell_kinds(3)) {
      SCOPED_TRACE(text_of("round ", round, ", cell ", static_cast<int>(kind)));
      expect_right<3>(kind, random);
      if (kind != CellKind::two_vectors) expect_right<2>(kind, random);
      if (testing::Test::HasFailure()) return;
    }
  }
}

// Half of the cell's width away, two images are equally near.
TEST(ImagePairs, OfTwoEquallyNearImages) {
  Eigen::Matrix3Xd centers(3, 2);
  centers << 0, 0.15, 0, 0, 0, 0;
  const Cell cell = box(0.3, 4, 4);
  const Balls<3> balls(centers, std::vector<double>(2, 0.075));
  EXPECT_THAT(image_pairs_by_force(balls, cell, {{{0, 1}}, true, 1}, 0), ElementsAre(BeadPair{0, 1}));
  const Balls<3> less(centers, std::vector<double>(2, std::nextafter(0.075, 0)));
  EXPECT_THAT(image_pairs_by_force(less, cell, {{{0, 1}}, true, 1}, 0), IsEmpty());
}

TEST(ImagePairs, RefuseBeadsFarFromTheCell) {
  Eigen::Matrix3Xd centers(3, 2);
  centers << 0, 1e9, 0, 0, 0, 0;
  const Balls<3> balls(centers, std::vector<double>(2, 1));
  EXPECT_THROW((void)image_pairs_by_cells(balls, box(4, 4, 4), {{{0, 1}}, true, 1}, 0), InputError);
}

}  // namespace
}  // namespace kds::image_pairs_test
