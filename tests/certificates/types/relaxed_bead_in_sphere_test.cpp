#include "certificates/types/bead_in_sphere.h"

#include <gtest/gtest.h>

#include "motions/curves/bezier_motion.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/rational_geometry.h"
#include "tests/support/rounds.h"
#include "tests/support/searches.h"

namespace kds::relaxed_bead_in_sphere_test {
namespace {

using Points = std::vector<std::array<double, 3>>;
using test::RationalPoint;

template <int Size>
RelaxedBeadInSphere<Size> first_beads(const Relaxation& relaxation) {
  std::array<BeadId, Size + 1> beads{};
  for (std::size_t i = 0; i <= Size; ++i) beads[i] = static_cast<BeadId>(i);
  return {beads, relaxation};
}

template <int Size>
int inside(const Points& points, double share) {
  return test::sign_at(first_beads<Size>(Relaxation::of(share)), test::at_rest(points), Dyadic(0.0));
}

TEST(Relaxation, IsAWholeNumberOfUnitsNoMoreThanAskedFor) {
  EXPECT_FALSE(Relaxation().any());
  EXPECT_FALSE(Relaxation::of(0x1.fp-21).any());
  EXPECT_EQ(Relaxation::of(Relaxation::least_share).units(), 1);
  EXPECT_EQ(Relaxation::of(1), Relaxation::greatest());
  for (const double share : {0.25, 0.01, 0.03, 0.1, 0.999}) {
    const Relaxation relaxation = Relaxation::of(share);
    EXPECT_LE(relaxation.share(), share);
    EXPECT_GT(relaxation.share(), share - 0x1p-20);
    const Rational one_more = 1 + Rational(relaxation.share());
    EXPECT_EQ(fraction(relaxation.square_units(), Relaxation::one_squared), one_more * one_more - 1);
  }
}

// A relaxation of a quarter: 5/4 of the radius.
TEST(RelaxedBeadInSphere, OfTwoBeadsReachesBeyondTheBallOnTheirDiameter) {
  const std::array<double, 3> a{-4, 0, 0}, b{4, 0, 0};
  EXPECT_EQ(inside<2>({a, b, {0, 5, 0}}, 0.25), 0);
  EXPECT_EQ(inside<2>({a, b, {0, 3, -4}}, 0.25), 0);
  EXPECT_EQ(inside<2>({a, b, {-5, 0, 0}}, 0.25), 0);
  EXPECT_EQ(inside<2>({a, b, {0, 0, 4.99}}, 0.25), 1);
  EXPECT_EQ(inside<2>({a, b, b}, 0.25), 1);
  EXPECT_EQ(inside<2>({a, b, {0, 0, 5.01}}, 0.25), -1);
  EXPECT_EQ(inside<2>({a, b, {0, 8, 0}}, 1), 0);
  EXPECT_EQ(inside<2>({a, b, {0, 0, 4 + 0x1p-17}}, 0x1p-20), -1);
  EXPECT_EQ(inside<2>({a, b, {0, 0, 4 + 0x1p-18}}, 0x1p-20), 0);
}

TEST(RelaxedBeadInSphere, OfThreeAndFourBeads) {
  const Points circle{{4, 0, 0}, {0, 4, 0}, {-4, 0, 0}};
  const Points sphere{{4, 0, 0}, {0, 4, 0}, {-4, 0, 0}, {0, 0, 4}};
  const Points turned{{0, 4, 0}, {4, 0, 0}, {-4, 0, 0}, {0, 0, 4}};  // the opposite orientation
  for (const auto& [p, sign] :
       {std::pair(std::array{0.0, -3.0, 4.0}, 0), std::pair(std::array{0.0, 5.0, 0.0}, 0),
        std::pair(std::array{0.0, 3.0, 3.9}, 1), std::pair(std::array{3.0, 4.0, 0.1}, -1)}) {
    for (const Points& basis : {circle, sphere, turned}) {
      Points points = basis;
      points.push_back(p);
      EXPECT_EQ(basis.size() == 3 ? inside<3>(points, 0.25) : inside<4>(points, 0.25), sign);
    }
  }
}

/// Compares with the centre computed by elimination. `share` is a multiple of the unit of relaxations.
template <int Size, Motion M>
void expect_larger_sphere(const M& motion, const Dyadic& time, double share) {
  const auto certificate = first_beads<Size>(Relaxation::of(share));
  const int found = test::sign_at(certificate, motion, time);
  EXPECT_EQ(found, test::exact_function(certificate, motion).sign_at(time));
  std::vector<RationalPoint> basis;
  for (BeadId b = 0; b < Size; ++b) basis.push_back(test::point_at(motion, b, time));
  const auto weights = test::circumcenter(basis);
  if (!weights) return;
  const RationalPoint center = test::combination(basis, *weights);
  const RationalPoint radius = test::minus(basis[0], center);
  const RationalPoint reach = test::minus(test::point_at(motion, Size, time), center);
  const test::second::Rational larger = 1 + test::second::Rational(share);
  EXPECT_EQ(found, test::sign(larger * larger * test::dot(radius, radius) - test::dot(reach, reach)));
}

TEST(RelaxedBeadInSphere, AgreesWithTheCentreSolvedFor) {
  test::Random random(731);
  for (int i = 0; i < test::rounds(40); ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("seed 731, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 5, kind);
      const auto plane = test::random_motion<BezierMotion<2, 2>>(random, 4, kind);
      const Dyadic time = test::random_dyadic(random);
      const double share = std::ldexp(static_cast<double>(test::pick(random, 1, 1 << 20)), -20);
      expect_larger_sphere<2>(motion, time, share);
      expect_larger_sphere<3>(motion, time, share);
      expect_larger_sphere<4>(motion, time, share);
      expect_larger_sphere<2>(plane, time, share);
      expect_larger_sphere<3>(plane, time, share);
    }
  }
}

// Without relaxation the certificate is a positive multiple of the certificate for the sphere itself.
TEST(RelaxedBeadInSphere, WithoutRelaxationItIsTheSphereItself) {
  test::Random random(732);
  for (int i = 0; i < 50; ++i) {
    const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 4, test::MotionKind::generic);
    const Dyadic time = test::random_dyadic(random);
    EXPECT_EQ(test::sign_at(first_beads<2>({}), motion, time),
              test::sign_at(BeadInSphere<2>{{0, 1, 2}, true}, motion, time));
    EXPECT_EQ(test::sign_at(first_beads<3>({}), motion, time),
              test::sign_at(BeadInSphere<3>{{0, 1, 2, 3}, true}, motion, time));
  }
}

TEST(RelaxedBeadInSphere, IdentitiesTellRelaxationsApart) {
  EXPECT_EQ(first_beads<4>(Relaxation::of(0.5)).identity(), first_beads<4>(Relaxation::of(0.5)).identity());
  EXPECT_NE(first_beads<4>(Relaxation::of(0.5)).identity(), first_beads<4>(Relaxation::of(0.25)).identity());
  EXPECT_NE(first_beads<2>(Relaxation::of(0.5)).identity(), first_beads<3>(Relaxation::of(0.5)).identity());
}

// All kernels find the first failure that a scan for sign changes in exact arithmetic finds.
template <int Size, Motion M>
void expect_first_failures(unsigned seed) {
  test::Random random(seed);
  int failures = 0;
  StageCounts filter_stages;
  for (int i = 0; i < test::rounds(120); ++i) {
    const auto kind = test::all_motion_kinds[static_cast<std::size_t>(i) % test::all_motion_kinds.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(i));
    const auto motion = test::random_motion<M>(random, Size + 1, kind);
    const auto certificate = first_beads<Size>(Relaxation::of(i % 2 == 0 ? 0.03 : 0.75));
    StageCounts stages;
    const Failure exact =
        test::first_failure(Kernel::exact, certificate, motion, Instant(), KnownAtStart::unknown, stages);
    const Failure filtered = test::first_failure(Kernel::filtered, certificate, motion, Instant(),
                                                 KnownAtStart::unknown, filter_stages);
    ASSERT_EQ(exact.kind, filtered.kind);
    const ExactPolynomial function = test::exact_function(certificate, motion);
    if (exact.kind == Failure::Kind::later) {
      ++failures;
      EXPECT_LE(filtered.time.lower, exact.time.upper);
      EXPECT_LE(exact.time.lower, filtered.time.upper);
      for (int k = 1; k < 16; ++k) {
        const double u = k / 16.0;
        EXPECT_TRUE(u >= filtered.time.lower || function.sign_at(Dyadic(u)) >= 0);
      }
    } else if (exact.kind == Failure::Kind::never) {
      for (int k = 1; k < 16; ++k) EXPECT_GE(function.sign_at(Dyadic(k / 16.0)), 0);
    }
  }
  EXPECT_GE(failures, test::rounds(3));
  if (M::degree == 1) {
    EXPECT_GT(filter_stages.coefficients, 0U);  // the first filter decides some linear motions
    EXPECT_GT(filter_stages.isolation, 0U);
  }
}

TEST(RelaxedBeadInSphere, KernelsAgreeOnFirstFailures) {
  expect_first_failures<2, BezierMotion<3, 1>>(741);
  expect_first_failures<3, BezierMotion<3, 1>>(742);
  expect_first_failures<4, BezierMotion<3, 1>>(743);
  expect_first_failures<4, BezierMotion<3, 3>>(744);
  expect_first_failures<3, BezierMotion<2, 3>>(745);
}

// A batch of four certificates with different relaxations gives the same failures as each certificate alone.
TEST(RelaxedBeadInSphere, ABatchTellsRelaxationsApart) {
  test::Random random(746);
  std::size_t failures = 0;
  for (int i = 0; i < test::rounds(60); ++i) {
    SCOPED_TRACE("seed 746, round " + std::to_string(i));
    const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 4, test::MotionKind::generic);
    std::vector<RelaxedBeadInSphere<3>> batch;
    for (const double share : {0.03, 0.03, 0.75, 0.25, 0.25, 0.25, 0.03}) {
      batch.push_back(first_beads<3>(Relaxation::of(share)));
    }
    const std::vector<KnownAtStart> known(batch.size(), KnownAtStart::unknown);
    std::vector<Failure> together(batch.size());
    StageCounts stages;
    search_over<RelaxedBeadInSphere<3>>(MotionRef<3>(motion))
        ->first_failures(Kernel::filtered, batch, Instant(), known, stages, TouchPolicy::ignored, together);
    for (std::size_t k = 0; k < batch.size(); ++k) {
      const Failure alone =
          test::first_failure(Kernel::filtered, batch[k], motion, Instant(), KnownAtStart::unknown, stages);
      ASSERT_EQ(together[k].kind, alone.kind);
      if (alone.kind != Failure::Kind::later) continue;
      ++failures;
      EXPECT_EQ(together[k].time.lower, alone.time.lower);
      EXPECT_EQ(together[k].time.upper, alone.time.upper);
    }
  }
  EXPECT_GT(failures, 0U);
}

}  // namespace
}  // namespace kds::relaxed_bead_in_sphere_test
