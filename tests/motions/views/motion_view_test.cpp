#include "motions/views/integer_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <type_traits>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/curves/positions.h"
#include "motions/views/lanes_view.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/sturm.h"

namespace kds::motion_view_test {
namespace {

namespace sturm = test::sturm;

Rational power_of_two(int exponent) {
  const Rational power(Integer(1) << static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Rational(1 / power) : power;
}

// Returns a control point as rationals: the coordinates, then the weight.
template <Motion M>
Rational control(const M& motion, BeadId bead, int k, int axis) {
  return Dyadic(axis < M::dimension ? motion.coordinate(bead, k, axis) : motion.weight(bead, k)).rational();
}

template <Motion M>
void expect_exact(const M& motion, const Dyadic& time) {
  std::array<BeadId, 3> beads{0, 1, 2};
  const IntegerView<M> whole(motion, beads);
  const MomentView<M> moment(motion, beads, time);
  const Rational scale = power_of_two(whole_scale(motion, beads).exponent);
  // Scale factors of the moment's numbers: (denominator)^degree for lengths, and its square for weights.
  Rational later = 1;
  for (int k = 0; k < M::degree; ++k) later *= power_of_two(static_cast<int>(time.exponent()));

  for (const auto& [i, j] : {std::pair<BeadId, BeadId>{0, 1}, {2, 0}, {1, 1}}) {
    const auto centers = whole.difference(i, j);
    const auto weights = whole.weight_difference(i, j);
    const auto there = moment.difference(i, j);
    const auto heavy = moment.weight_difference(i, j);
    const auto pi = exact_position(motion, i, time);
    const auto pj = exact_position(motion, j, time);
    for (int axis = 0; axis <= M::dimension; ++axis) {
      const bool weight = axis == M::dimension;
      const Rational factor = weight ? Rational(scale * scale) : scale;
      const auto& polynomial = weight ? weights : centers[static_cast<std::size_t>(axis)];
      for (int k = 0; k <= M::degree; ++k) {
        const Rational difference = control(motion, i, k, axis) - control(motion, j, k, axis);
        EXPECT_EQ(Rational(polynomial.scaled[static_cast<std::size_t>(k)]),
                  binomial(M::degree, k) * factor * difference);
      }
      const Rational at_time = pi[static_cast<std::size_t>(axis)] - pj[static_cast<std::size_t>(axis)];
      const auto& value = weight ? heavy : there[static_cast<std::size_t>(axis)];
      EXPECT_EQ(Rational(value.scaled[0]), at_time * factor * (weight ? Rational(later * later) : later));
      // and both equal the value of the polynomial at that time
      EXPECT_EQ(sturm::value(sturm::from_scaled(polynomial.scaled), time.rational()), at_time * factor);
    }
    const auto thicker = whole.radius_difference(i, j);
    const auto reach = whole.radius_sum(i, j);
    for (int k = 0; k <= M::degree; ++k) {
      const Rational ri = Dyadic(motion.radius(i, k)).rational();
      const Rational rj = Dyadic(motion.radius(j, k)).rational();
      const auto place = static_cast<std::size_t>(k);
      EXPECT_EQ(Rational(thicker.scaled[place]), binomial(M::degree, k) * scale * (ri - rj));
      EXPECT_EQ(Rational(reach.scaled[place]), binomial(M::degree, k) * scale * (ri + rj));
    }
    const Rational ri = exact_radius(motion, i, time);
    const Rational rj = exact_radius(motion, j, time);
    EXPECT_EQ(Rational(moment.radius_difference(i, j).scaled[0]), (ri - rj) * scale * later);
    EXPECT_EQ(Rational(moment.radius_sum(i, j).scaled[0]), (ri + rj) * scale * later);
    EXPECT_EQ(sturm::value(sturm::from_scaled(reach.scaled), time.rational()), (ri + rj) * scale);
  }
}

TEST(MotionViews, ExactOnesAreScaledCopies) {
  test::Random random(41);
  for (int i = 0; i < 40; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      const Dyadic time = test::random_dyadic(random);
      SCOPED_TRACE("seed 41, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      expect_exact(test::random_motion<BezierMotion<3, 1>>(random, 3, kind), time);
      expect_exact(test::random_motion<BezierMotion<2, 2>>(random, 3, kind), time);
      expect_exact(test::random_motion<BezierMotion<1, 3>>(random, 3, kind), time);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(MotionViews, ExactOnesKnowNoLimits) {
  test::Random random(42);
  for (const int exponent : {-1074, -1060, -1000, -500, 500, 1000, 1022}) {
    for (const int weight_exponent : {-1074, -1001, -1000, 0, 1000, 1001}) {
      auto motion = test::random_motion<BezierMotion<3, 1>>(random, 3, test::MotionKind::generic);
      for (BeadId b = 0; b < 3; ++b) {
        for (int k = 0; k <= 1; ++k) {
          for (int axis = 0; axis < 3; ++axis) {
            if (axis == 2 && b == 1) continue;  // one coordinate stays ordinary
            motion.set_coordinate(b, k, axis, std::ldexp(motion.coordinate(b, k, axis), exponent));
          }
          motion.set_weight(b, k, std::ldexp(motion.weight(b, k), weight_exponent));
          motion.set_radius(b, k, std::ldexp(motion.radius(b, k), weight_exponent / 2));
        }
      }
      expect_exact(motion, test::random_dyadic(random));
    }
  }
}

TEST(MotionViews, MomentsAtTheEndsAreTheFrames) {
  test::Random random(43);
  const auto motion = test::random_motion<BezierMotion<3, 3>>(random, 3, test::MotionKind::generic);
  for (const double u : {0.0, 1.0}) {
    const int k = u == 0 ? 0 : 3;
    for (BeadId b = 0; b < 3; ++b) {
      const auto position = exact_position(motion, b, Dyadic(u));
      for (int axis = 0; axis <= 3; ++axis)
        EXPECT_EQ(position[static_cast<std::size_t>(axis)], control(motion, b, k, axis));
    }
    EXPECT_EQ(approximate_positions(motion, u), control_points(motion, k));
  }
  expect_exact(motion, Dyadic(0.0));
  expect_exact(motion, Dyadic(1.0));
}

TEST(MotionViews, WholeNumbersNeedNoScale) {
  BezierMotion<2, 1> motion(2);
  const std::array<BeadId, 2> beads{0, 1};
  EXPECT_LT(whole_scale(motion, beads).exponent, 0);  // all numbers are zero
  motion.set_coordinate(0, 0, 0, 3);
  EXPECT_EQ(whole_scale(motion, beads).exponent, 0);
  motion.set_coordinate(1, 1, 1, 0.125);
  EXPECT_EQ(whole_scale(motion, beads).exponent, 3);
  motion.set_weight(1, 0, 0x1p-7);  // weights are scaled by the square
  EXPECT_EQ(whole_scale(motion, beads).exponent, 4);
  motion.set_weight(1, 0, 0x1p-8);
  EXPECT_EQ(whole_scale(motion, beads).exponent, 4);
  motion.set_radius(0, 1, 0x1p-9);
  EXPECT_EQ(whole_scale(motion, beads).exponent, 9);
  // Numbers that the view does not need do not increase the scale.
  EXPECT_EQ(whole_scale(motion, beads, Channels{}).exponent, 3);
  EXPECT_EQ(whole_scale(motion, beads, Channels{.weights = true, .radii = false}).exponent, 4);
  EXPECT_EQ((IntegerView<BezierMotion<2, 1>>(motion, beads, Channels{}).difference(0, 1)[0].scaled[0]), 24);
}

// The view of doubles records the largest value that it returned.
TEST(DoubleView, KnowsTheLargestLength) {
  BezierMotion<2, 1> motion(3);
  motion.set_coordinate(1, 1, 1, -5);
  motion.set_coordinate(2, 0, 0, 9);
  const DoubleView<BezierMotion<2, 1>> view(motion);
  EXPECT_EQ(view.largest_length(), 0);
  (void)view.difference(0, 1);
  EXPECT_EQ(view.largest_length(), 5);
  motion.set_weight(0, 1, 24);
  (void)view.weight_difference(0, 1);
  EXPECT_EQ(view.largest_length(), 5);
  motion.set_weight(0, 1, -49);
  (void)view.weight_difference(0, 1);
  EXPECT_EQ(view.largest_length(), 7);
  (void)view.weight(0);
  EXPECT_EQ(view.largest_length(), 7);
  (void)view.difference(2, 1);
  EXPECT_EQ(view.largest_length(), 9);
  motion.set_radius(0, 1, 10);
  motion.set_radius(1, 1, 6);
  (void)view.radius_difference(0, 1);
  EXPECT_EQ(view.largest_length(), 9);
  (void)view.radius_sum(0, 1);
  EXPECT_EQ(view.largest_length(), 16);
}

TEST(MotionViews, AnswerWithRadiiIfToldSo) {
  test::Random random(45);
  using M = BezierMotion<3, 2>;
  for (int i = 0; i < 50; ++i) {
    auto motion = test::random_motion<M>(random, 5, test::MotionKind::generic);
    const LanesView<M, 2, Channels{.radii = true}> lanes(motion, {{{0, 1}, {1, 2}, {2, 3}, {3, 4}}});
    const DoubleView<M> one(motion);
    const auto sum = lanes.radius_sum(0, 1);
    const auto difference = lanes.radius_difference(0, 1);
    for (BeadId lane = 0; lane < 4; ++lane) {
      for (std::size_t k = 0; k <= 2; ++k) {
        EXPECT_EQ(sum.scaled[k].v[lane], one.radius_sum(lane, lane + 1).scaled[k]);
        EXPECT_EQ(difference.scaled[k].v[lane], one.radius_difference(lane, lane + 1).scaled[k]);
        const double reach =
            motion.radius(lane, static_cast<int>(k)) + motion.radius(lane + 1, static_cast<int>(k));
        EXPECT_GE(lanes.largest_length().v[lane], reach);
        const std::array beads{lane, lane + 1};
        const TrackedDouble tracked = TrackedView<M>(motion, beads).radius_sum(beads[0], beads[1]).scaled[k];
        EXPECT_EQ(tracked.value, sum.scaled[k].v[lane] * scale_to_unit(motion, beads));
      }
    }
  }
}

TEST(MotionViews, InDoubleTheyAreNearTheExactOne) {
  test::Random random(44);
  for (int i = 0; i < 200; ++i) {
    const auto kind = test::all_motion_kinds[random() % test::all_motion_kinds.size()];
    const auto motion = test::random_motion<BezierMotion<3, 3>>(random, 2, kind);
    const auto rounded = DoubleView<BezierMotion<3, 3>>(motion).difference(1, 0);
    const std::array<BeadId, 2> beads{0, 1};
    const TrackedView<BezierMotion<3, 3>> view(motion, beads);
    const auto tracked = view.difference(1, 0);
    const auto weights = view.weight_difference(1, 0);
    const double scale = scale_to_unit(motion, beads);
    const Rational unit = Dyadic(scale).rational();
    for (int axis = 0; axis <= 3; ++axis) {
      for (int k = 0; k <= 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const Rational exact = (axis == 3 ? unit * unit : unit) * binomial(3, k) *
                               (control(motion, 1, k, axis) - control(motion, 0, k, axis));
        const TrackedDouble& t =
            axis == 3 ? weights.scaled[at] : tracked[static_cast<std::size_t>(axis)].scaled[at];
        EXPECT_LE(abs(Dyadic(t.value).rational() - exact),
                  Dyadic(t.error).rational() * Dyadic(TrackedDouble::inflation).rational());
        EXPECT_TRUE(axis == 3 || t.value == rounded[static_cast<std::size_t>(axis)].scaled[at] * scale);
      }
    }
  }
}

TEST(MotionViews, TrackedAtAUsefulScaleWhereverDifferencesAreFinite) {
  using M = BezierMotion<2, 1>;
  const std::array<BeadId, 2> beads{0, 1};
  for (int exponent = -1073; exponent <= 1023; ++exponent) {
    M motion(2);
    motion.set_coordinate(1, 0, 0, std::ldexp(1.5, exponent));
    const bool square_is_normal = std::abs(2 * exponent) < 1022;
    if (square_is_normal) motion.set_weight(1, 0, std::ldexp(1.0, 2 * exponent));
    const TrackedView<M> view(motion, beads);
    const TrackedDouble x = view.difference(1, 0)[0].scaled[0];
    EXPECT_GE(x.value, 0x1p-52) << exponent;
    EXPECT_LT(x.value, 2.5) << exponent;
    EXPECT_LE(x.error, x.value * 0x1p-52) << exponent;
    const double weight = view.weight_difference(1, 0).scaled[0].value;
    EXPECT_EQ(weight, square_is_normal ? 1 : 0) << exponent;
  }
  M same(2);
  EXPECT_EQ(scale_to_unit(same, beads), 1);
  same.set_coordinate(0, 0, 0, -0x1p1023);
  same.set_coordinate(1, 0, 0, 0x1p1023);  // their difference overflows
  EXPECT_EQ(scale_to_unit(same, beads), 1);
}

// A degree that is known only at run time: exact views return the motion's values, and for compiled degrees
// the same coefficients. Views of motions of any degree require the degree as an argument.
static_assert(std::is_default_constructible_v<MagnitudeView<3, 1>>);
static_assert(!std::is_default_constructible_v<MagnitudeView<3, any_degree>>);
static_assert(std::is_constructible_v<MagnitudeView<3, any_degree>, int>);

TEST(AnyDegreeMotion, IsSeenAsItIs) {
  test::Random random(5);
  for (const int degree : {1, 2, 3, 6}) {
    AnyDegreeMotion<2> any(3, degree);
    BezierMotion<2, 3> cubic(3);
    for (BeadId b = 0; b < 3; ++b) {
      for (int k = 0; k <= degree; ++k) {
        any.set_coordinate(b, k, 0, test::uniform(random));
        any.set_coordinate(b, k, 1, test::pick(random, -9, 9));
        any.set_weight(b, k, test::uniform(random));
        any.set_radius(b, k, test::uniform(random));
        if (degree != 3) continue;
        for (int axis = 0; axis < 2; ++axis) cubic.set_coordinate(b, k, axis, any.coordinate(b, k, axis));
        cubic.set_weight(b, k, any.weight(b, k));
        cubic.set_radius(b, k, any.radius(b, k));
      }
    }
    const std::array<BeadId, 3> beads{0, 1, 2};
    const IntegerView<AnyDegreeMotion<2>> view(any, beads);
    const Rational scale = power_of_two(whole_scale(any, beads).exponent);
    for (const Dyadic& time : {Dyadic(0.0), Dyadic(0.3), Dyadic(0.75), Dyadic(1.0)}) {
      const auto p = exact_position(any, 0, time);
      const auto q = exact_position(any, 1, time);
      const auto at = [&](const auto& polynomial) {
        return sturm::value(sturm::from_scaled(polynomial.scaled), time.rational());
      };
      const auto d = view.difference(0, 1);
      EXPECT_EQ(at(d[0]), scale * (p[0] - q[0]));
      EXPECT_EQ(at(d[1]), scale * (p[1] - q[1]));
      EXPECT_EQ(at(view.weight_difference(0, 1)), scale * scale * (p[2] - q[2]));
      EXPECT_EQ(at(view.weight(1)), scale * scale * q[2]);
      EXPECT_EQ(at(view.radius_sum(0, 1)), scale * (exact_radius(any, 0, time) + exact_radius(any, 1, time)));
    }
    if (degree != 3) continue;
    for (std::size_t axis = 0; axis < 2; ++axis)
      EXPECT_EQ(exact_position(any, 2, Dyadic(0.3))[axis], exact_position(cubic, 2, Dyadic(0.3))[axis]);
    const auto expect_same = [](const auto& a, const auto& b) {
      ASSERT_EQ(a.scaled.size(), b.scaled.size());
      for (std::size_t k = 0; k < b.scaled.size(); ++k) EXPECT_EQ(a.scaled[k], b.scaled[k]);
    };
    const IntegerView<BezierMotion<2, 3>> whole(cubic, beads);
    const DoubleView<AnyDegreeMotion<2>> rounded_any(any);
    const DoubleView<BezierMotion<2, 3>> rounded(cubic);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      expect_same(view.difference(0, 1)[axis], whole.difference(0, 1)[axis]);
      expect_same(rounded_any.difference(0, 1)[axis], rounded.difference(0, 1)[axis]);
    }
    expect_same(view.weight_difference(2, 1), whole.weight_difference(2, 1));
    expect_same(rounded_any.radius_sum(2, 1), rounded.radius_sum(2, 1));
    EXPECT_EQ(rounded_any.largest_length(), rounded.largest_length());
  }
}

// Checks the lift of every view and of exact positions: |x|^2 minus the weight moves linearly, without the
// common drift.
TEST(LiftedMotion, LiftsAreLinear) {
  test::Random random(6);
  LiftedMotion<3> motion(2);
  for (BeadId b = 0; b < 2; ++b) {
    for (int k = 0; k <= 1; ++k) {
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, k, axis, test::uniform(random));
      motion.set_weight(b, k, test::uniform(random));
    }
  }
  motion.set_drift({0.25, -0.5, 1.0 / 3});
  const auto lift = [&](BeadId b, const Dyadic& time) {
    const auto p = exact_position(motion, b, time);
    Rational sum = -p[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Rational x = p[static_cast<std::size_t>(axis)] - time.rational() * Rational(motion.drift(axis));
      sum += x * x;
    }
    return sum;
  };
  const Rational start = lift(0, Dyadic(0.0)), end = lift(0, Dyadic(1.0));
  const Dyadic time(0.375);
  EXPECT_EQ(lift(0, time), start + time.rational() * (end - start));
  EXPECT_EQ(exact_position(motion, 0, Dyadic(1.0))[3], Rational(motion.weight(0, 1)));
  EXPECT_LT(exact_position(motion, 0, time)[3], Rational(std::max(motion.weight(0, 0), motion.weight(0, 1))));

  // lift_difference leaves out a multiple of the difference of the centres: 2 (start of bead 1) .
  // (difference).
  const std::array<BeadId, 2> beads{0, 1};
  const Rational scale =
      power_of_two(whole_scale(motion, beads, Channels{.weights = true, .radii = false}).exponent);
  const auto whole = IntegerView<LiftedMotion<3>>(motion, beads, Channels{.weights = true, .radii = false})
                         .lift_difference(0, 1);
  const auto rounded = DoubleView<LiftedMotion<3>>(motion).lift_difference(0, 1);
  const auto tracked = TrackedView<LiftedMotion<3>>(motion, beads).lift_difference(0, 1);
  const double tracked_scale = scale_to_unit(motion, std::span<const BeadId>(beads));
  for (const double u : {0.0, 1.0}) {
    const auto k = static_cast<std::size_t>(u);
    const auto p = exact_position(motion, 0, Dyadic(u));
    const auto q = exact_position(motion, 1, Dyadic(u));
    Rational expected = lift(0, Dyadic(u)) - lift(1, Dyadic(u));
    for (std::size_t axis = 0; axis < 3; ++axis)
      expected -= 2 * Rational(motion.coordinate(1, 0, static_cast<int>(axis))) * (p[axis] - q[axis]);
    EXPECT_EQ(Rational(whole.scaled[k]), scale * scale * expected);
    EXPECT_NEAR(rounded.scaled[k], expected.get_d(), 1e-14);
    EXPECT_LE(std::abs(tracked.scaled[k].value - expected.get_d() * tracked_scale * tracked_scale),
              tracked.scaled[k].error + 1e-16);
  }
}

}  // namespace
}  // namespace kds::motion_view_test
