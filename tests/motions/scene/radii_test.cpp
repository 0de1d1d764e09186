#include "motions/scene/radii.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "motions/numbers/exact_number.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/vdw_radii.h"
#include "tests/motions/test_files.h"

namespace kds::radii_test {
namespace {

Trajectory necklace(const std::vector<std::vector<double>>& frames, double y = 0) {
  Trajectory trajectory;
  trajectory.file = "n.xyz";
  for (const auto& places : frames) {
    trajectory.frames.emplace_back(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(places.size())));
    trajectory.frames.back().row(1).setConstant(y);
    for (std::size_t i = 0; i < places.size(); ++i)
      trajectory.frames.back()(0, static_cast<Eigen::Index>(i)) = places[i];
  }
  trajectory.element_radii.assign(trajectory.bead_count(), 1.0);
  return trajectory;
}

std::vector<double> radii(const std::string& policy, const std::vector<Trajectory>& necklaces) {
  return bead_radii(policy, necklaces);
}

void refuse(const std::string& policy, const std::vector<Trajectory>& necklaces,
            std::initializer_list<std::string_view> parts) {
  test::expect_refused([&] { (void)radii(policy, necklaces); }, parts);
}

using Radii = std::vector<double>;

TEST(Radii, AutoIsHalfTheLongestBond) {
  EXPECT_EQ(radii("auto", {necklace({{0, 1, 2}, {0, 1.5, 2}})}), Radii(3, 0.75));
  Trajectory broken = necklace({{0, 1, 11, 12}, {0, 1, 12, 14}});
  broken.breaks = {1};
  EXPECT_EQ(radii("auto", {broken}), Radii(4, 1));
  EXPECT_EQ(radii("auto", {broken, necklace({{0, 5}})}), Radii(6, 2.5));
  EXPECT_EQ(radii("auto", {necklace({{7}}), necklace({{0, 5}})}), Radii(3, 2.5));
}

// Returns the exact square of a bond's length minus the squared sum of the radii.
Rational gap(const Eigen::Matrix3Xd& frame, Eigen::Index bead, double radius) {
  Rational rest = -4 * Dyadic(radius).rational() * Dyadic(radius).rational();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational d = Dyadic(frame(axis, bead + 1)).rational() - Dyadic(frame(axis, bead)).rational();
    rest += d * d;
  }
  return rest;
}

TEST(Radii, AutoIsTheLeastOfWhichTheEndsOfTheLongestBondMeet) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const double scale : {1.0, 1e-3, 1e10, 0x1p-1060, 0x1p500}) {
    for (int round = 0; round < 50; ++round) {
      Trajectory trajectory = necklace({{0, 0, 0, 0}});
      for (double& x : trajectory.frames[0].reshaped()) x = scale * place(random);
      const double radius = radii("auto", {trajectory}).front();
      const auto most_gap = [&](double r) {
        return std::max({gap(trajectory.frames[0], 0, r), gap(trajectory.frames[0], 1, r),
                         gap(trajectory.frames[0], 2, r)});
      };
      EXPECT_LE(most_gap(radius), 0);
      EXPECT_GT(most_gap(std::nextafter(radius, 0)), 0);
    }
  }
}

TEST(Radii, AutoNeedsABond) {
  refuse("auto", {necklace({{3}})}, {"--radius NUMBER"});
  refuse("auto", {necklace({{3, 3}, {4, 4}})}, {"--radius NUMBER"});
  refuse("auto", {necklace({{-1.5e308, 1.5e308}})}, {"--radius NUMBER"});
  refuse("auto", {}, {"--radius NUMBER"});
}

TEST(Radii, Number) {
  EXPECT_EQ(radii("0.75", {necklace({{0, 1}})}), Radii(2, 0.75));
  EXPECT_EQ(radii("1e-3", {necklace({{0}}), necklace({{0}})}), Radii(2, 0.001));
}

TEST(Radii, Element) {
  Trajectory trajectory = necklace({{0, 1}});
  trajectory.element_radii = {1.55, 1.7};
  EXPECT_EQ(radii("element", {trajectory, necklace({{0}})}), (Radii{1.55, 1.7, 1}));
  trajectory.element_radii.clear();
  refuse("element", {necklace({{0}}), trajectory}, {"--radius", "element", "n.xyz"});
  refuse("element:fit", {trajectory}, {"--radius", "element:fit", "n.xyz"});
  trajectory.element_lack = "t.psf does not tell the element of LP1";
  refuse("element", {trajectory},
         {"needs the elements of all beads: t.psf does not tell the element of LP1;"});
}

TEST(Radii, FittedBallsAreDisjoint) {
  // Beads 0 and 2 are 1.5 apart, so radii of 1 shrink to slightly below 0.75.
  const Radii fitted = radii("element:fit", {necklace({{0, 0.75, 1.5}})});
  EXPECT_LT(fitted[0] + fitted[2], 1.5);
  EXPECT_NEAR(fitted[0], 0.75, 1e-9);
  EXPECT_EQ(fitted[0], fitted[1]);
  // Fitted radii never exceed the element's radius, and only the first frame counts.
  EXPECT_EQ(radii("element:fit", {necklace({{0, 3, 6}, {0, 0, 0}})}), Radii(3, 1));
  // Balls that just touch count as touching.
  EXPECT_LT(radii("element:fit", {necklace({{0, 1, 2}})})[0], 1);
  // Neighbours may overlap; beads of different necklaces may not.
  EXPECT_EQ(radii("element:fit", {necklace({{0, 0.1}})}), Radii(2, 1));
  const Radii two = radii("element:fit", {necklace({{0, 9}}), necklace({{0, 9}}, 0.5)});
  EXPECT_LT(two[0] + two[2], 0.5);
  EXPECT_NEAR(two[0], 0.25, 1e-9);
}

TEST(Radii, CoincidentBeadsCannotBeFitted) {
  refuse("element:fit", {necklace({{0, 1, 0}})}, {"--radius", "bead 0", "bead 2"});
  refuse("element:fit", {necklace({{0, 1}}), necklace({{1, 2}})}, {"bead 1 of n.xyz", "bead 0 of n.xyz"});
  EXPECT_EQ(radii("element:fit", {necklace({{0, 0, 5}})}).size(), 3U);
}

TEST(Radii, FittedRadiiOfARealFile) {
  const std::vector<Trajectory> necklaces{read_trajectory(test::data_file("proteins/2f4k.pdb"))};
  const Radii fitted = radii("element:fit", necklaces);
  const Eigen::Matrix3Xd& frame = necklaces[0].frames[0];
  double least_gap = 10;
  for (Eigen::Index i = 0; i < frame.cols(); ++i)
    for (Eigen::Index j = i + 2; j < frame.cols(); ++j)
      least_gap =
          std::min(least_gap, (frame.col(i) - frame.col(j)).norm() - fitted[static_cast<std::size_t>(i)] -
                                  fitted[static_cast<std::size_t>(j)]);
  EXPECT_GT(least_gap, 0);
  EXPECT_LT(least_gap, 1e-9);
}

TEST(VdwRadii, Table) {
  EXPECT_EQ(van_der_waals_radius("C"), 1.7);
  EXPECT_EQ(van_der_waals_radius("n"), 1.55);
  EXPECT_EQ(van_der_waals_radius("CL"), 1.75);
  EXPECT_EQ(van_der_waals_radius("Se"), 1.9);
  EXPECT_EQ(van_der_waals_radius("D"), 1.2);
  for (const char* symbol : {"", "X", "Xx", "C1", "ABC", "Og", "1", " C"})
    EXPECT_FALSE(van_der_waals_radius(symbol).has_value()) << symbol;
}

}  // namespace
}  // namespace kds::radii_test
