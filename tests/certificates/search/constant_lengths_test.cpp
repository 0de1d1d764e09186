// Compares certificates whose constants are lengths and squared lengths with rational references.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "certificates/search/define_certificate_search.h"
#include "examples/new_certificate.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "tests/support/judges/searched_constants.h"
#include "tests/support/rounds.h"

namespace kds::constant_lengths_test {
namespace {

using test::difference;
using test::MotionKind;
using test::pick;
using test::product;
using test::Random;
using test::RationalCurve;

/// The squared distance of two beads is greater than `square` plus the difference of their weights minus
/// `between`.
struct Apart {
  static constexpr CertificateType type{1003, "apart"};
  static constexpr bool uses_weights = true;
  struct Constants {
    Constant<2> square, between;
  };
  std::array<BeadId, 2> beads{};
  bool apart = true;
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return apart; }
  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& b) {
    const auto d = view.difference(b[0], b[1]);
    const auto weights = view.weight_difference(b[0], b[1]) - view.constant(&Constants::between);
    return dot(d, d) - elevate<2 * View::degree>(view.constant(&Constants::square) + weights);
  }
};

template <Motion M>
RationalCurve squared_distance(const M& motion) {
  RationalCurve total{0};
  for (int axis = 0; axis < M::dimension; ++axis) {
    const RationalCurve d =
        difference(test::rational_coordinate(motion, 0, axis), test::rational_coordinate(motion, 1, axis));
    total = test::sum(total, product(d, d));
  }
  return total;
}

Near opposite(Near certificate) {
  certificate.near = !certificate.near;
  return certificate;
}
Apart opposite(Apart certificate) {
  certificate.apart = !certificate.apart;
  return certificate;
}

template <class Certificate, Motion M>
void expect_all_along(Certificate certificate, const M& motion,
                      const typename Certificate::Constants& constants, const RationalCurve& twin,
                      test::DecidedInDouble& count) {
  const auto search = search_over<Certificate>(MotionRef<M::dimension>(motion));
  search->set_constants(constants);
  test::expect_judged_all_along(
      *search, certificate, twin, 0, [](const Certificate& c) { return opposite(c); }, count);
}

/// Cutoffs times 2^exponent over motions of all kinds, which are scaled by 2^of_motion.
template <Motion M>
test::DecidedInDouble expect_near_as_judged(int rounds, int exponent, int of_motion) {
  Random random(2101);
  test::DecidedInDouble count;
  for (int i = 0; i < rounds; ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("round " + std::to_string(i) + ", kind " + std::to_string(static_cast<int>(kind)));
      auto motion = test::random_motion<M>(random, 2, kind);
      test::scale(motion, of_motion);
      const auto cutoff = test::random_constant(random, M::degree, exponent);
      const RationalCurve c = test::rational_curve(cutoff, M::degree);
      expect_all_along(Near{{0, 1}, random() % 2 == 0}, motion, {.cutoff = Constant<1>(cutoff)},
                       difference(product(c, c), squared_distance(motion)), count);
      if (testing::Test::HasFailure()) return count;
    }
  }
  return count;
}

TEST(ConstantLengths, CutoffsThatChangeAreAsJudged) {
  expect_near_as_judged<BezierMotion<3, 1>>(test::rounds(10), 0, 0);
  expect_near_as_judged<BezierMotion<2, 1>>(test::rounds(10), 0, 0);
  expect_near_as_judged<BezierMotion<3, 3>>(test::rounds(3), 0, 0);
  expect_near_as_judged<BezierMotion<2, 3>>(test::rounds(3), 0, 0);
}

TEST(ConstantLengths, HugeAndTinyOnesAreAsJudged) {
  for (const int exponent : {-300, 300}) {
    expect_near_as_judged<BezierMotion<3, 1>>(1, exponent, 0);
    expect_near_as_judged<BezierMotion<2, 3>>(1, exponent, 0);
    expect_near_as_judged<BezierMotion<3, 1>>(1, exponent, exponent);
  }
}

TEST(ConstantLengths, AreDecidedInDoubleAtAllScales) {
  for (const int exponent : {-300, 0, 300}) {
    Random random(2102);
    test::DecidedInDouble count;
    for (int i = 0; i < 50; ++i) {
      auto motion = test::random_motion<BezierMotion<3, 1>>(random, 2, MotionKind::generic);
      test::scale(motion, exponent);
      const std::vector<double> cutoff{std::ldexp(test::uniform(random, 0.5, 1.5), exponent),
                                       std::ldexp(test::uniform(random, 0.5, 1.5), exponent)};
      const RationalCurve c = test::rational_curve(cutoff, 1);
      expect_all_along(Near{{0, 1}, true}, motion, {.cutoff = Constant<1>(cutoff)},
                       difference(product(c, c), squared_distance(motion)), count);
    }
    EXPECT_EQ(count.decided, 50);
    EXPECT_EQ(count.in_double, count.decided) << "times 2^" << exponent;
  }
}

template <Motion M>
void expect_apart_as_judged(int rounds) {
  Random random(2103);
  test::DecidedInDouble count;
  for (int i = 0; i < rounds; ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("round " + std::to_string(i) + ", kind " + std::to_string(static_cast<int>(kind)));
      const auto motion = test::random_motion<M>(random, 2, kind);
      const int exponent = i % 3 == 2 ? pick(random, -600, 600) : 0;
      const auto square = test::random_constant(random, M::degree, exponent),
                 between = test::random_constant(random, M::degree);
      std::vector<double> weights[2];
      for (BeadId b = 0; b < 2; ++b)
        for (int k = 0; k <= M::degree; ++k) weights[b].push_back(motion.weight(b, k));
      const auto curve = [](const std::vector<double>& c) { return test::rational_curve(c, M::degree); };
      RationalCurve twin = difference(squared_distance(motion), curve(square));
      twin = difference(twin, difference(curve(weights[0]), curve(weights[1])));
      twin = test::sum(twin, curve(between));
      expect_all_along(Apart{{0, 1}, random() % 2 == 0}, motion,
                       {.square = Constant<2>(square), .between = Constant<2>(between)}, twin, count);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ConstantLengths, SquaredOnesAreAsJudged) {
  expect_apart_as_judged<BezierMotion<3, 1>>(test::rounds(10));
  expect_apart_as_judged<BezierMotion<3, 3>>(test::rounds(3));
}

/// Makes a bead that flies past another bead at this distance; they are closest at u = 1/2.
BezierMotion<2, 1> flying_past(double distance) {
  BezierMotion<2, 1> motion(2);
  motion.set_coordinate(0, 0, 0, -1);
  motion.set_coordinate(0, 1, 0, 1);
  for (int k = 0; k < 2; ++k) motion.set_coordinate(0, k, 1, distance);
  return motion;
}

Failure first_failure(Kernel kernel, const CertificateSearch<Near>& search, const Near& certificate,
                      TouchPolicy touches = TouchPolicy::ignored) {
  Failure failure;
  const KnownAtStart known = KnownAtStart::unknown;
  StageCounts stages;
  search.first_failures(kernel, {&certificate, 1}, Instant(0), {&known, 1}, stages, touches, {&failure, 1});
  return failure;
}

TEST(ConstantLengths, ACutoffThatIsJustReachedIsATouch) {
  for (const double distance : {1.0, 0.1, 0x1p-300, 0x1p300, 0.0}) {
    const auto motion = flying_past(distance);
    const auto search = search_over<Near>(MotionRef<2>(motion));
    search->set_constants({.cutoff = distance});
    const Near far{{0, 1}, false};
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      EXPECT_EQ(first_failure(kernel, *search, far).kind, Failure::Kind::never);
      const Failure touch = first_failure(kernel, *search, far, TouchPolicy::reported);
      ASSERT_EQ(touch.kind, Failure::Kind::later);
      EXPECT_TRUE(touch.time.touch);
      EXPECT_LE(touch.time.lower, 0.5);
      EXPECT_GE(touch.time.upper, 0.5);
      if (distance == 0) continue;
      search->set_constants({.cutoff = std::nextafter(distance, 2 * distance)});
      EXPECT_EQ(first_failure(kernel, *search, far).kind,
                distance > 0x1p100 ? Failure::Kind::at_birth : Failure::Kind::later);
      search->set_constants({.cutoff = distance});
    }
  }
}

TEST(ConstantLengths, BeadsThatRestAtTheCutoffAreZero) {
  BezierMotion<2, 1> motion(2);
  for (int k = 0; k < 2; ++k) {
    motion.set_coordinate(1, k, 0, 3);
    motion.set_coordinate(1, k, 1, 4);
  }
  const auto search = search_over<Near>(MotionRef<2>(motion));
  search->set_constants({.cutoff = 5});
  for (const bool side : {true, false})
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact})
      EXPECT_EQ(first_failure(kernel, *search, Near{{0, 1}, side}).kind, Failure::Kind::zero);
  search->set_constants({.cutoff = {5, 4}});  // the cutoff is reached only at the start
  EXPECT_EQ(first_failure(Kernel::filtered, *search, Near{{0, 1}, true}).kind, Failure::Kind::at_birth);
  EXPECT_EQ(first_failure(Kernel::filtered, *search, Near{{0, 1}, false}).kind, Failure::Kind::never);
  // The cutoff is reached at the end, which belongs to the next step.
  search->set_constants({.cutoff = {4, 5}});
  EXPECT_EQ(first_failure(Kernel::filtered, *search, Near{{0, 1}, false}).kind, Failure::Kind::never);
}

TEST(ConstantLengths, ManyAtOnceAreAsOneByOne) {
  Random random(2104);
  const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 30, MotionKind::generic);
  const auto search = search_over<Near>(MotionRef<3>(motion));
  search->set_constants({.cutoff = {0.9, 1.2}});
  std::vector<Near> certificates;
  for (BeadId b = 1; b < 30; ++b) certificates.push_back({{b, 0}, b % 3 == 0});
  std::vector<KnownAtStart> known(certificates.size());
  std::vector<Failure> failures(certificates.size());
  StageCounts stages;
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    search->first_failures(kernel, certificates, Instant(0), known, stages, TouchPolicy::ignored, failures);
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      const Failure alone = first_failure(kernel, *search, certificates[i]);
      EXPECT_EQ(failures[i].kind, alone.kind);
      EXPECT_EQ(failures[i].time.lower, alone.time.lower);
      EXPECT_EQ(failures[i].time.upper, alone.time.upper);
    }
  }
}

template <class Exception, class Do>
std::string refusal(Do what) {
  try {
    what();
  } catch (const Exception& reason) {
    return reason.what();
  }
  return "";
}

TEST(ConstantLengths, WhatIsNoneIsRefused) {
  const AnyDegreeMotion<3> motion(2, 3);
  const auto search = search_over<Near>(MotionRef<3>(motion));
  EXPECT_EQ(refusal<std::logic_error>([&] {
              (void)first_failure(Kernel::filtered, *search, {{0, 1}});
            }),
            "near: its constants are not set");
  const auto set = [&](const Constant<1>& cutoff) {
    return refusal<std::invalid_argument>([&] { search->set_constants({.cutoff = cutoff}); });
  };
  EXPECT_EQ(set({}),
            "near: constant 1 of 1 has 0 control points: expected 1, or 4 as the motion's curves have");
  EXPECT_EQ(set({1, 2}),
            "near: constant 1 of 1 has 2 control points: expected 1, or 4 as the motion's curves have");
  EXPECT_EQ(set({1, 2, 3, std::numeric_limits<double>::infinity()}), "near: constant 1 of 1 is not finite");
  EXPECT_EQ(set(std::nan("")), "near: constant 1 of 1 is not finite");
  EXPECT_EQ(set({1, 2, 3, 4}), "");
}

TEST(ConstantLengths, OverLiftedMotionWeightsAreRefusedAndLengthsAreNot) {
  LiftedMotion<3> motion(2);
  EXPECT_NE(refusal<std::invalid_argument>([&] { (void)search_over<Apart>(MotionRef<3>(motion)); }), "");
  motion.set_coordinate(0, 0, 0, 2);
  const auto search = search_over<Near>(MotionRef<3>(motion));
  search->set_constants({.cutoff = 1});
  const Failure failure = first_failure(Kernel::exact, *search, {{0, 1}, false});
  EXPECT_LE(failure.time.lower, 0.5);
  EXPECT_GE(failure.time.upper, 0.5);
  EXPECT_NEAR(failure.time.lower, failure.time.upper, 1e-9);
}

}  // namespace
}  // namespace kds::constant_lengths_test
