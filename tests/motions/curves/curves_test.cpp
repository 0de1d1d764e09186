#include "motions/curves/curves.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/curves/motion_ref.h"
#include "motions/curves/snapshot.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::curves_test {
namespace {

template <Motion M>
void expect_same(const Curves<M::dimension>& curves, const M& motion) {
  ASSERT_EQ(curves.own_degree(), degree_of(motion));
  ASSERT_EQ(curves.bead_count(), motion.bead_count());
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 0; k <= curves.own_degree(); ++k) {
      EXPECT_EQ(curves.control_point(b, k), motion.control_point(b, k));
      for (int axis = 0; axis < M::dimension; ++axis)
        EXPECT_EQ(curves.coordinate(b, k, axis), motion.coordinate(b, k, axis));
      EXPECT_EQ(curves.weight(b, k), motion.weight(b, k));
      EXPECT_EQ(curves.radius(b, k), motion.radius(b, k));
    }
  }
}

template <Motion M>
void expect_seen(test::Random& random) {
  for (const std::size_t beads : {0, 1, 2, 7}) {
    const M motion = test::random_motion<M>(random, beads, test::MotionKind::generic);
    const Curves<M::dimension> curves(motion);
    expect_same(curves, motion);
    const Curves<M::dimension> end = curves.at_end();
    EXPECT_EQ(end.own_degree(), 0);
    ASSERT_EQ(end.bead_count(), beads);
    for (BeadId b = 0; b < beads; ++b) {
      for (int axis = 0; axis < M::dimension; ++axis)
        EXPECT_EQ(end.coordinate(b, 0, axis), motion.coordinate(b, M::degree, axis));
      EXPECT_EQ(end.weight(b, 0), motion.weight(b, M::degree));
      EXPECT_EQ(end.radius(b, 0), motion.radius(b, M::degree));
    }
  }
}

TEST(Curves, AreTheMotionWhereItLies) {
  test::Random random(1);
  expect_seen<BezierMotion<1, 1>>(random);
  expect_seen<BezierMotion<2, 2>>(random);
  expect_seen<BezierMotion<3, 1>>(random);  // records are longer than their content
  expect_seen<BezierMotion<3, 3>>(random);
  expect_seen<LiftedMotion<2>>(random);
}

TEST(Curves, OfOneMomentAreOfDegreeZero) {
  test::Random random(2);
  Snapshot<2> snapshot;
  snapshot.set(test::random_motion<BezierMotion<2, 2>>(random, 5, test::MotionKind::generic), 2);
  expect_same(Curves<2>(snapshot), snapshot);
}

TEST(Curves, OfALiftedMotionKnowItsDrift) {
  LiftedMotion<3> motion(2);
  motion.set_drift({1, 2, 3});
  const LiftedCurves<3> curves(motion);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(curves.drift(axis), axis + 1);
  static_assert(lifted<CurvesOf<LiftedMotion<3>>> && !lifted<CurvesOf<BezierMotion<3, 1>>>);
}

// A motion that stores the control points of each bead in a column.
struct InColumns {
  static constexpr int dimension = 2, degree = 1;
  double numbers[2][8] = {};
  double radius_numbers[2][2] = {};
  [[nodiscard]] std::size_t bead_count() const { return 2; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const { return &numbers[k][4 * bead]; }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return radius_numbers[bead]; }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }
};
static_assert(Motion<InColumns>);

TEST(Curves, OfControlPointsThatDoNotLieInARowAreRefused) {
  EXPECT_THROW((void)Curves<2>(InColumns{}), std::invalid_argument);
}

// A motion of three beads whose first control points and radii are at given places.
struct AtPlaces {
  static constexpr int dimension = 1, degree = 2;
  std::array<std::size_t, 3> point_places{0, 6, 12}, radius_places{20, 23, 26};
  std::size_t last_stride = 2;  // distance from one control point of the last bead to the next
  std::array<double, 40> numbers{};
  [[nodiscard]] std::size_t bead_count() const { return 3; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return &numbers[point_places[bead] + (bead == 2 ? last_stride : 2) * static_cast<std::size_t>(k)];
  }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return &numbers[radius_places[bead]]; }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }
};
static_assert(Motion<AtPlaces>);

TEST(Curves, AreRefusedWhereTheLastBeadLiesElsewhere) {
  AtPlaces motion;
  expect_same(Curves<1>(motion), motion);
  motion.point_places[2] = 13;
  EXPECT_THROW((void)Curves<1>(motion), std::invalid_argument);
  motion.point_places[2] = 12;
  motion.radius_places[2] = 27;
  EXPECT_THROW((void)Curves<1>(motion), std::invalid_argument);
  motion.radius_places[2] = 26;
  motion.last_stride = 3;
  EXPECT_THROW((void)Curves<1>(motion), std::invalid_argument);
}

// A reference to a temporary motion would dangle, so it does not compile.
static_assert(std::is_constructible_v<MotionRef<2>, const BezierMotion<2, 1>&>);
static_assert(!std::is_constructible_v<MotionRef<2>, BezierMotion<2, 1>>);
static_assert(!std::is_constructible_v<MotionRef<2>, const BezierMotion<2, 1>>);

TEST(MotionRef, RefusesAMotionWhoseDegreeHasChanged) {
  AnyDegreeMotion<2> motion(3, 2);
  const MotionRef<2> ref(motion);
  motion = AnyDegreeMotion<2>(5, 2);
  EXPECT_EQ(ref.bead_count(), 5U);
  motion = AnyDegreeMotion<2>(3, 4);
  try {
    (void)ref.curves();
    FAIL();
  } catch (const std::logic_error& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "a motion of degree 2 has become one of degree 4: structures and searches over it must be "
                 "made anew");
  }
}

TEST(MotionRef, SeesWhateverTheMotionIsSetTo) {
  BezierMotion<2, 3> motion(3);
  const MotionRef<2> ref(motion);
  EXPECT_EQ(ref.degree(), 3);
  EXPECT_EQ(ref.bead_count(), 3U);
  EXPECT_FALSE(ref.is_lifted());
  motion = BezierMotion<2, 3>(5);
  motion.set_coordinate(4, 2, 1, 7);
  EXPECT_EQ(ref.bead_count(), 5U);
  EXPECT_EQ(ref.curves().coordinate(4, 2, 1), 7);
  ref.visit([](const auto& curves) { EXPECT_EQ(curves.own_degree(), 3); });
}

TEST(MotionRef, KnowsLiftedMotion) {
  LiftedMotion<2> motion(1);
  const MotionRef<2> ref(motion);
  motion.set_drift({3, 4});
  EXPECT_TRUE(ref.is_lifted());
  EXPECT_EQ(ref.degree(), 1);
  EXPECT_EQ(ref.lifted_curves().drift(1), 4);
  const bool seen_lifted = ref.visit([]<class C>(const C&) { return lifted<C>; });
  EXPECT_TRUE(seen_lifted);
}

template <Motion M>
void expect_finite_alone(M motion) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {inf, -inf, std::numeric_limits<double>::quiet_NaN()}) {
    motion.set_coordinate(1, 1, 0, 5);
    motion.set_weight(1, 1, 6);
    motion.set_radius(1, 1, 7);
    EXPECT_THROW(motion.set_coordinate(1, 1, 0, bad), std::invalid_argument);
    EXPECT_THROW(motion.set_weight(1, 1, bad), std::invalid_argument);
    EXPECT_THROW(motion.set_radius(1, 1, bad), std::invalid_argument);
    EXPECT_EQ(motion.coordinate(1, 1, 0), 5);  // unchanged
    EXPECT_EQ(motion.weight(1, 1), 6);
    EXPECT_EQ(motion.radius(1, 1), 7);
  }
  motion.set_coordinate(1, 1, 0, std::numeric_limits<double>::max());
  motion.set_coordinate(1, 1, 0, -0x1p-1074);
}

TEST(ControlPoints, AreFiniteNumbers) {
  expect_finite_alone(BezierMotion<1, 1>(2));
  expect_finite_alone(BezierMotion<3, 3>(2));
  expect_finite_alone(LiftedMotion<2>(2));
  expect_finite_alone(AnyDegreeMotion<3>(2, 5));
  LiftedMotion<2> motion(1);
  EXPECT_THROW(motion.set_drift({0, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  try {
    motion.set_weight(0, 0, std::numeric_limits<double>::infinity());
    FAIL();
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("finite"), std::string::npos);
  }
}

TEST(AnyDegreeMotion, HasNoNegativeDegree) {
  try {
    const AnyDegreeMotion<2> motion(4, -1);
    FAIL();
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "a motion of degree -1: expected 0 or more");
  }
  EXPECT_EQ(AnyDegreeMotion<2>(4, 0).own_degree(), 0);
}

TEST(AnyDegreeMotion, KeepsItsControlPoints) {
  for (const int degree : {1, 2, 7}) {
    AnyDegreeMotion<2> motion(4, degree);
    const auto number = [](BeadId b, int k, int place) { return 100.0 * b + 10.0 * k + place; };
    for (BeadId b = 0; b < 4; ++b) {
      for (int k = 0; k <= degree; ++k) {
        EXPECT_EQ(motion.weight(b, k), 0);
        for (int axis = 0; axis < 2; ++axis) motion.set_coordinate(b, k, axis, number(b, k, axis));
        motion.set_weight(b, k, number(b, k, 2));
        motion.set_radius(b, k, number(b, k, 3));
      }
    }
    EXPECT_EQ(degree_of(motion), degree);
    EXPECT_EQ(motion.bead_count(), 4U);
    for (BeadId b = 0; b < 4; ++b) {
      for (int k = 0; k <= degree; ++k) {
        for (int axis = 0; axis < 2; ++axis) EXPECT_EQ(motion.coordinate(b, k, axis), number(b, k, axis));
        EXPECT_EQ(motion.weight(b, k), number(b, k, 2));
        EXPECT_EQ(motion.radius(b, k), number(b, k, 3));
      }
    }
    expect_same(Curves<2>(motion), motion);
    EXPECT_EQ(MotionRef<2>(motion).degree(), degree);
  }
}

}  // namespace
}  // namespace kds::curves_test
