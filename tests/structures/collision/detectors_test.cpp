// Compares every static detector with brute force, and brute force with rationals.

#include "tests/structures/collision/detectors.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/inputs/ball_sets.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/colliding_pairs.h"
#include "tests/support/rounds.h"

namespace kds::detectors_test {
namespace {

using namespace test;

// Returns a random partition into necklaces and a random question about it.
template <class Generator>
PairsAsked random_question(Generator& random, BeadId beads) {
  PairsAsked asked;
  for (BeadId first = 0; first < beads;) {
    const auto size = static_cast<BeadId>(1 + random() % (random() % 3 == 0 ? 3 : beads));
    const BeadId last = std::min(beads - 1, first + size - 1);
    asked.necklaces.push_back({first, last});
    first = last + 1;
  }
  static constexpr std::array<BeadId, 6> apart{1, 2, 2, 2, 3, 7};
  asked.apart = apart[random() % apart.size()];
  asked.within = random() % 6 != 0;
  asked.between = random() % 6 != 0;
  if (random() % 4 == 0)
    for (std::size_t n = 0; n < asked.necklaces.size(); ++n) asked.at_rest.push_back(random() % 2 != 0);
  return asked;
}

template <int Dimension>
void ask_all_about_hard_sets(unsigned cases, BeadId most_beads, bool over_rationals) {
  DetectorsSeen seen;
  for (unsigned seed = 0; seed < rounds(cases) && !testing::Test::HasFailure(); ++seed) {
    std::mt19937 random(15485863 * seed + Dimension);
    const std::size_t kind = seed % hard_ball_sets;
    const auto beads = static_cast<BeadId>(1 + random() % (seed % 7 == 0 ? 3 : most_beads));
    const bool equal = random() % 2 == 0;
    const BallSet set = hard_ball_set(random, kind, Eigen::Index{beads}, equal, Dimension == 2);
    const Balls<Dimension> balls(set.centers, set.radii);
    const PairsAsked asked = random_question(random, beads);
    // A distance at which some pairs are exactly, or almost, within reach.
    const auto a = static_cast<BeadId>(random() % beads), b = static_cast<BeadId>(random() % beads);
    const double gap = (set.centers.col(a) - set.centers.col(b)).stableNorm() - set.radii[a] - set.radii[b];
    const double distance = random() % 3 == 0 ? 0.5 * set.radii[a] : std::max(0.0, gap);
    const std::string what = set.name + ", seed " + std::to_string(seed);
    if (over_rationals) {
      ASSERT_EQ(pairs_by_force(balls, asked), pairs_over_rationals(set.centers, set.radii, asked)) << what;
      ASSERT_EQ(pairs_by_force(balls, asked, distance),
                pairs_over_rationals(set.centers, set.radii, asked, distance))
          << what;
    }
    expect_detectors_agree(balls, asked, distance, what, seen);
  }
  EXPECT_GT(seen.colliding, seen.cases / 4);
  EXPECT_GT(seen.touching, seen.cases / 40);
}

TEST(Detectors, OfHardSetsInSpace) { ask_all_about_hard_sets<3>(2400, 24, true); }
TEST(Detectors, OfHardSetsInThePlane) { ask_all_about_hard_sets<2>(2400, 24, true); }
TEST(Detectors, OfLargerHardSets) {
  ask_all_about_hard_sets<3>(120, 200, false);
  ask_all_about_hard_sets<2>(120, 200, false);
}

// Makes a chain of beads that stays in a box. Bonds are about one diameter long, and radii are equal or
// different.
BallSet random_necklace(Random& random, BeadId beads, bool equal, bool flat) {
  BallSet set;
  set.name = "necklace";
  set.centers = Eigen::Matrix3Xd::Zero(3, Eigen::Index{beads});
  const double box = 1.5 * std::cbrt(beads);
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (BeadId b = 0; b < beads; ++b) {
    const double radius = equal ? 0.5 : uniform(random, 0.2, 0.8);
    if (b > 0) {
      Eigen::Vector3d step(uniform(random, -1, 1), uniform(random, -1, 1), flat ? 0 : uniform(random, -1, 1));
      if (step.norm() < 1e-3) step = Eigen::Vector3d::UnitX();
      place += step.normalized() * (radius + set.radii.back()) * uniform(random, 0.7, 1);
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        if (std::abs(place[axis]) > box) place[axis] *= 0.8;
    }
    set.centers.col(Eigen::Index{b}) = place;
    set.radii.push_back(radius);
  }
  return set;
}

template <int Dimension>
void ask_all_about_necklaces(unsigned cases, BeadId most_beads) {
  DetectorsSeen seen;
  for (unsigned seed = 0; seed < rounds(cases) && !testing::Test::HasFailure(); ++seed) {
    Random random(49979687 * seed + Dimension);
    const auto beads = static_cast<BeadId>(1 + random() % most_beads);
    BallSet set = random_necklace(random, beads, random() % 2 == 0, Dimension == 2);
    if (seed % 4 == 0)  // few pairs collide, or none
      for (double& radius : set.radii) radius *= 10.0 / (10 + beads);
    const Balls<Dimension> balls(set.centers, set.radii);
    const PairsAsked asked = random() % 2 == 0 ? all_pairs({{0, beads - 1}}) : random_question(random, beads);
    expect_detectors_agree(balls, asked, uniform(random, 0, 1), "seed " + std::to_string(seed), seen);
  }
  EXPECT_GT(seen.colliding, seen.cases / 3);
  EXPECT_TRUE(seen.cases < 500 || seen.colliding < seen.cases);
}

TEST(Detectors, OfTenThousandRandomNecklaces) {
  ask_all_about_necklaces<3>(5000, 30);
  ask_all_about_necklaces<2>(5000, 30);
}
TEST(Detectors, OfLongRandomNecklaces) {
  ask_all_about_necklaces<3>(20, 1500);
  ask_all_about_necklaces<2>(20, 1500);
}

// Rows of a grid run to and fro; beads of radius 0.5 (times `scale`) exactly touch the adjacent beads.
template <int Dimension>
void ask_all_about_a_grid(BeadId side, double scale, const Eigen::Vector3d& shift) {
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, Dimension == 2 ? side * side : side * side * side);
  for (BeadId b = 0; b < centers.cols(); ++b) {
    const BeadId row = b / side, layer = row / side;
    const BeadId x = row % 2 == 0 ? b % side : side - 1 - b % side;
    const BeadId y = layer % 2 == 0 ? row % side : side - 1 - row % side;
    centers.col(Eigen::Index{b}) = scale * (Eigen::Vector3d(x, y, layer) + shift);
  }
  const auto beads = static_cast<BeadId>(centers.cols());
  const Balls<Dimension> balls(centers, std::vector<double>(beads, 0.5 * scale));
  DetectorsSeen seen;
  const std::string what = "grid of side " + std::to_string(side) + " at scale " + std::to_string(scale);
  const PairsAsked asked = all_pairs({{0, beads - 1}});
  expect_detectors_agree(balls, asked, 0.5 * scale, what, seen);
  // The grid has d n^(d-1) (n-1) touching pairs. The question leaves out the pairs along the chain.
  const BeadId lines = Dimension == 2 ? side : side * side;
  EXPECT_EQ(pairs_by_force(balls, asked).size(), Dimension * lines * (side - 1) - (beads - 1)) << what;
  expect_detectors_agree(balls, all_pairs({{0, beads / 2 - 1}, {beads / 2, beads - 1}}), scale, what, seen);
  EXPECT_EQ(seen.touching, 2U) << what;
}

TEST(Detectors, OfGridsThatTouch) {
  for (const double scale : {1.0, 3.0, 0x1p-300, 0x1p300}) {
    ask_all_about_a_grid<2>(9, scale, {0, 0, 0});
    ask_all_about_a_grid<3>(5, scale, {0, 0, 0});
    ask_all_about_a_grid<3>(4, scale, {0x1p40, -0x1p45, 0x1p30});
  }
  for (const double scale : {0x1p-520, 0x1p505}) {  // scales at which all pairs are decided over rationals
    ask_all_about_a_grid<2>(5, scale, {0, 0, 0});
    ask_all_about_a_grid<3>(3, scale, {0, 0, 0});
  }
  ask_all_about_a_grid<2>(rounds(30U, 12U), 1, {0, 0, 0});
  ask_all_about_a_grid<3>(rounds(10U, 6U), 1, {0, 0, 0});
}

TEST(Detectors, OfCoincidentBeadsAndPoints) {
  DetectorsSeen seen;
  for (const BeadId beads : {1U, 2U, 3U, 40U}) {
    Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Constant(3, Eigen::Index{beads}, 0.1);
    for (const double radius : {0.0, 1.0}) {
      const Balls<3> balls(centers, std::vector<double>(beads, radius));
      expect_detectors_agree(balls, all_pairs({{0, beads - 1}}, 1), 0.25, "coincident", seen);
      EXPECT_EQ(pairs_by_force(balls, all_pairs({{0, beads - 1}}, 1)).size(), beads * (beads - 1) / 2);
      EXPECT_EQ(pairs_by_force(balls, all_pairs({{0, beads - 1}}, beads)).size(), 0U);
    }
  }
  // Points on a line, two at each place.
  Eigen::Matrix3Xd centers(3, 60);
  for (BeadId b = 0; b < 60; ++b) centers.col(Eigen::Index{b}) = (b / 2) * Eigen::Vector3d(1, 2, -3);
  const Balls<3> points(centers, std::vector<double>(60, 0));
  expect_detectors_agree(points, all_pairs({{0, 59}}, 1), std::sqrt(14.0), "points", seen);
  EXPECT_EQ(pairs_by_force(points, all_pairs({{0, 59}}, 1)).size(), 30U);
}

TEST(Detectors, OfCoordinatesWhoseSquaresOverflow) {
  Random random(11);
  for (const double scale : {0x1p1020, 0x1p-1060}) {
    Eigen::Matrix3Xd centers(3, 30);
    std::vector<double> equal(30, 2 * scale), unequal;
    for (Eigen::Index b = 0; b < 30; ++b) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) centers(axis, b) = scale * (random() % 12);
      unequal.push_back(scale * (random() % 4));
    }
    const PairsAsked asked = all_pairs({{0, 14}, {15, 29}});
    for (const auto& radii : {equal, unequal}) {
      const Balls<3> balls(centers, radii);
      const auto expected = pairs_over_rationals(centers, radii, asked);
      EXPECT_EQ(pairs_by_force(balls, asked), expected);
      EXPECT_FALSE(expected.empty());
      expect_hierarchies_agree(balls, asked, expected, scale, "scale " + std::to_string(std::log2(scale)));
    }
  }
}

}  // namespace
}  // namespace kds::detectors_test
