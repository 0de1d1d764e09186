#include "certificates/types/bead_in_sphere.h"

#include <gtest/gtest.h>

#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/rounds.h"
#include "tests/support/searches.h"

namespace kds::bead_in_sphere_test {
namespace {

using test::identity_with;

using Points = std::vector<std::array<double, 3>>;
using test::RationalPoint;

template <int Size>
int inside(const Points& points) {
  BeadInSphere<Size> certificate;
  for (std::size_t i = 0; i <= Size; ++i) certificate.beads[i] = static_cast<BeadId>(i);
  return test::sign_at(certificate, test::at_rest(points), Dyadic(0.0));
}

TEST(BeadInSphere, OfOneBeadHoldsOnlyCoincidentOnes) {
  EXPECT_EQ(inside<1>({{1, 2, 3}, {1, 2, 3}}), 0);
  EXPECT_EQ(inside<1>({{1, 2, 3}, {1, 2, 3.5}}), -1);
}

TEST(BeadInSphere, OfTwoBeadsIsTheBallOnTheirDiameter) {
  const std::array<double, 3> a{-1, 0, 0};
  const std::array<double, 3> b{1, 0, 0};
  EXPECT_EQ(inside<2>({a, b, {0, 0, 0}}), 1);
  EXPECT_EQ(inside<2>({a, b, {0, 0.5, 0.5}}), 1);
  EXPECT_EQ(inside<2>({a, b, {0, 1, 0}}), 0);
  EXPECT_EQ(inside<2>({a, b, b}), 0);
  EXPECT_EQ(inside<2>({a, b, {0, 1, 0.001}}), -1);
  EXPECT_EQ(inside<2>({a, b, {2, 0, 0}}), -1);
}

TEST(BeadInSphere, OfThreeBeadsHasTheirCircle) {
  const Points circle{{5, 0, 0}, {-3, 4, 0}, {-3, -4, 0}};
  const auto with = [&](const std::array<double, 3>& p) {
    Points points = circle;
    points.push_back(p);
    return inside<3>(points);
  };
  EXPECT_EQ(with({0, 0, 0}), 1);
  EXPECT_EQ(with({0, 0, 4.999}), 1);
  EXPECT_EQ(with({0, 0, 5}), 0);
  EXPECT_EQ(with({0, 3, -4}), 0);
  EXPECT_EQ(with({-3, 4, 0}), 0);
  EXPECT_EQ(with({0, 3, -4.001}), -1);
  EXPECT_EQ(with({100, 0, 0}), -1);
}

TEST(BeadInSphere, GuardsEitherSide) {
  const auto motion = test::at_rest(Points{{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(test::sign_at(BeadInSphere<2>{{0, 1, 2}, true}, motion, Dyadic(0.0)), 1);
  EXPECT_EQ(test::sign_at(BeadInSphere<2>{{0, 1, 2}, false}, motion, Dyadic(0.0)), -1);
}

template <int Size, Motion M>
void expect_circumsphere(const M& motion, const Dyadic& time) {
  std::vector<RationalPoint> basis;
  BeadInSphere<Size> certificate;
  for (BeadId b = 0; b <= Size; ++b) {
    certificate.beads[b] = b;
    if (b < Size) basis.push_back(test::point_at(motion, b, time));
  }
  const auto weights = test::circumcenter(basis);
  const int found = test::sign_at(certificate, motion, time);
  EXPECT_EQ(found, test::exact_function(certificate, motion).sign_at(time));
  certificate.inside = false;
  EXPECT_EQ(test::sign_at(certificate, motion, time), -found);
  if (!weights) return;
  const RationalPoint center = test::combination(basis, *weights);
  const RationalPoint radius = test::minus(basis[0], center);
  const RationalPoint reach = test::minus(test::point_at(motion, Size, time), center);
  EXPECT_EQ(found, test::sign(test::dot(radius, radius) - test::dot(reach, reach)));
}

TEST(BeadInSphere, AgreesWithTheCentreSolvedFor) {
  test::Random random(721);
  for (int i = 0; i < test::rounds(60); ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("seed 721, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 4, kind);
      const auto plane = test::random_motion<BezierMotion<2, 2>>(random, 4, kind);
      const Dyadic time = test::random_dyadic(random);
      expect_circumsphere<1>(motion, time);
      expect_circumsphere<2>(motion, time);
      expect_circumsphere<3>(motion, time);
      expect_circumsphere<2>(plane, time);
      expect_circumsphere<3>(plane, time);
    }
  }
}

TEST(BeadInSphere, DoesNotDependOnTheOrderOfTheBasis) {
  test::Random random(722);
  for (int i = 0; i < 50; ++i) {
    const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 4, test::MotionKind::generic);
    const auto function = test::exact_function(BeadInSphere<3>{{0, 1, 2, 3}, true}, motion);
    EXPECT_EQ(test::exact_function(BeadInSphere<3>{{2, 0, 1, 3}, true}, motion).scaled(), function.scaled());
    EXPECT_EQ(test::exact_function(BeadInSphere<3>{{1, 0, 2, 3}, true}, motion).scaled(), function.scaled());
    EXPECT_EQ(test::exact_function(BeadInSphere<2>{{1, 0, 2}, true}, motion).scaled(),
              test::exact_function(BeadInSphere<2>{{0, 1, 2}, true}, motion).scaled());
  }
}

// A bead leaves the basis when it enters the sphere of the other members, which is when its barycentric
// coordinate of the centre vanishes. The centre lies within the hull if and only if no bead leaves.
template <int Size>
void expect_leaving(const BezierMotion<3, 1>& motion, const Dyadic& time) {
  std::vector<RationalPoint> basis;
  for (BeadId b = 0; b < Size; ++b) basis.push_back(test::point_at(motion, b, time));
  const auto weights = test::circumcenter(basis);
  if (!weights) return;
  for (BeadId leaving = 0; leaving < Size; ++leaving) {
    BeadInSphere<Size - 1> stays{{}, false};
    for (BeadId b = 0, place = 0; b < Size; ++b) {
      if (b != leaving) stays.beads[place++] = b;
    }
    stays.beads[Size - 1] = leaving;
    EXPECT_EQ(test::sign_at(stays, motion, time), test::sign((*weights)[leaving]));
  }
}

TEST(BeadInSphere, LeavingIsALostBarycentricCoordinate) {
  test::Random random(723);
  for (int i = 0; i < 100; ++i) {
    for (const auto kind :
         {test::MotionKind::generic, test::MotionKind::grid, test::MotionKind::cospherical}) {
      SCOPED_TRACE("seed 723, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 4, kind);
      const Dyadic time = test::random_dyadic(random);
      expect_leaving<2>(motion, time);
      expect_leaving<3>(motion, time);
      expect_leaving<4>(motion, time);
    }
  }
}

// For four beads of equal radii, the power test times the orientation of the basis decides whether a bead is
// outside.
TEST(BeadInSphere, OfFourBeadsIsAPowerTest) {
  test::Random random(724);
  for (int i = 0; i < 100; ++i) {
    auto motion = test::random_motion<BezierMotion<3, 1>>(random, 5, test::MotionKind::generic);
    for (BeadId b = 0; b < 5; ++b) {
      for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, 0.25);
    }
    const Dyadic time = test::random_dyadic(random);
    std::vector<RationalPoint> basis;
    for (BeadId b = 0; b < 4; ++b) basis.push_back(test::point_at(motion, b, time));
    const auto weights = test::circumcenter(basis);
    ASSERT_TRUE(weights);
    const RationalPoint center = test::combination(basis, *weights);
    const RationalPoint radius = test::minus(basis[0], center);
    const RationalPoint reach = test::minus(test::point_at(motion, 4, time), center);
    EXPECT_EQ(test::sign_at(Orientation<3>({0, 1, 2, 3}, 1), motion, time) *
                  test::sign_at(PowerTest<3>({0, 1, 2, 3, 4}, 1), motion, time),
              test::sign(test::dot(reach, reach) - test::dot(radius, radius)));
  }
}

TEST(BeadInSphere, HasAnIdentityByBeads) {
  constexpr std::uint32_t type = BeadInSphere<1>::type.number;
  EXPECT_EQ((BeadInSphere<1>{{3, 1}, true}.identity()), identity_with(type, {3, 1}));
  EXPECT_EQ((BeadInSphere<3>{{1, 2, 3, 0}, true}.identity()), identity_with(type, {1, 2, 3, 0}));
  EXPECT_EQ((BeadInSphere<2>{{1, 2, 3}, true}.identity()), (BeadInSphere<2>{{1, 2, 3}, false}.identity()));
  EXPECT_NE((BeadInSphere<2>{{1, 2, 3}, true}.identity()), (BeadInSphere<2>{{1, 3, 2}, true}.identity()));
}

}  // namespace
}  // namespace kds::bead_in_sphere_test
