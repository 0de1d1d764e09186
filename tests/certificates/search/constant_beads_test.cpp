// Compares certificates with constant points, vectors and beads, and with positions of beads, with rational
// references.

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "certificates/search/define_certificate_search.h"
#include "examples/new_certificate.h"
#include "tests/support/judges/searched_constants.h"
#include "tests/support/rounds.h"

namespace kds::constant_beads_test {
namespace {

using test::difference;
using test::MotionKind;
using test::product;
using test::Random;
using test::RationalCurve;

/// In the plane, seen from the origin, a bead is to the left of the bead `other`. All certificates have the
/// same `other`.
struct LeftOf {
  static constexpr CertificateType type{1003, "left_of"};
  static constexpr bool uses_positions = true;
  struct Constants {
    ConstantBead other;
  };
  std::array<BeadId, 1> beads{};
  bool left = true;
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return left; }
  template <MotionView View>
  [[nodiscard]] static constexpr auto formula(const View& view, const std::array<BeadId, 1>& b) {
    const auto at = view.position(b[0]), other = view.position(view.bead(&Constants::other));
    return other[0] * at[1] - other[1] * at[0];
  }
};

/// A bead's first coordinate is positive.
struct Positive {
  static constexpr CertificateType type{1004, "positive"};
  static constexpr bool uses_positions = true;
  std::array<BeadId, 1> beads{};
  bool positive = true;
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return positive; }
  [[nodiscard]] static constexpr auto formula(const MotionView auto& view, const std::array<BeadId, 1>& b) {
    return view.position(b[0])[0];
  }
};

Above opposite(Above certificate) {
  certificate.above = !certificate.above;
  return certificate;
}
LeftOf opposite(LeftOf certificate) {
  certificate.left = !certificate.left;
  return certificate;
}
Positive opposite(Positive certificate) {
  certificate.positive = !certificate.positive;
  return certificate;
}

template <class Certificate>
void expect_all_along(const CertificateSearch<Certificate>& search, const Certificate& certificate,
                      const RationalCurve& twin, double start = 0) {
  test::DecidedInDouble count;
  test::expect_judged_all_along(
      search, certificate, twin, start, [](const Certificate& c) { return opposite(c); }, count);
}

/// The control points of a vector, as three curves. All curves have one control point, or as many as the
/// motion.
using Coordinates = std::array<std::vector<double>, 3>;
Coordinates random_vector(Random& random, int degree, int exponent) {
  Coordinates coordinates;
  do {
    for (auto& axis : coordinates) axis = test::random_constant(random, degree, exponent);
  } while (coordinates[1].size() != coordinates[0].size() || coordinates[2].size() != coordinates[0].size());
  return coordinates;
}
template <class ConstantType>
ConstantType constant_of(const Coordinates& coordinates) {
  std::vector<std::array<double, 3>> control_points;
  for (std::size_t k = 0; k < coordinates[0].size(); ++k)
    control_points.push_back({coordinates[0][k], coordinates[1][k], coordinates[2][k]});
  return ConstantType(std::span<const std::array<double, 3>>(control_points));
}

template <Motion M>
void expect_above_as_judged(int rounds, int exponent_of_foot, int exponent_of_normal, int of_motion) {
  Random random(2111);
  for (int i = 0; i < rounds; ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("round " + std::to_string(i) + ", kind " + std::to_string(static_cast<int>(kind)));
      auto motion = test::random_motion<M>(random, 2, kind);
      test::scale(motion, of_motion);
      const Coordinates foot = random_vector(random, M::degree, exponent_of_foot),
                        normal = random_vector(random, M::degree, exponent_of_normal);
      RationalCurve twin{0};
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        twin = test::sum(twin, product(difference(test::rational_coordinate(motion, 1, axis),
                                                  test::rational_curve(foot[a], M::degree)),
                                       test::rational_curve(normal[a], M::degree)));
      }
      const auto search = search_over<Above>(MotionRef<3>(motion));
      search->set_constants(
          {.foot = constant_of<ConstantPoint<3>>(foot), .normal = constant_of<ConstantVector<3>>(normal)});
      expect_all_along(*search, Above{{1}, random() % 2 == 0}, twin);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ConstantBeads, PlanesThatMoveAndTurnAreAsJudged) {
  expect_above_as_judged<BezierMotion<3, 1>>(test::rounds(10), 0, 0, 0);
  expect_above_as_judged<BezierMotion<3, 3>>(test::rounds(3), 0, 0, 0);
}

TEST(ConstantBeads, HugeAndTinyOnesAreAsJudged) {
  expect_above_as_judged<BezierMotion<3, 1>>(1, 0, 300, 0);
  expect_above_as_judged<BezierMotion<3, 1>>(1, 0, -300, 0);
  expect_above_as_judged<BezierMotion<3, 1>>(1, -300, 0, 0);
  expect_above_as_judged<BezierMotion<3, 3>>(1, 300, 0, 300);
  expect_above_as_judged<BezierMotion<3, 1>>(1, -300, -300, -300);
}

TEST(ConstantBeads, ABeadThatTouchesAPlaneStaysAbove) {
  BezierMotion<3, 3> motion(1);  // its height is (1 - 2u)^2
  const std::array<double, 4> height{1, -1.0 / 3, -1.0 / 3, 1};
  for (int k = 0; k < 4; ++k) motion.set_coordinate(0, k, 2, 3 * height[static_cast<std::size_t>(k)]);
  const auto search = search_over<Above>(MotionRef<3>(motion));
  search->set_constants({.foot = {{7, 8, 0}}, .normal = {{0, 0, 1}}});
  const KnownAtStart known = KnownAtStart::unknown;
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    for (const TouchPolicy touches : {TouchPolicy::ignored, TouchPolicy::reported}) {
      const Above certificate{{0}};
      Failure failure;
      StageCounts stages;
      search->first_failures(kernel, {&certificate, 1}, Instant(0), {&known, 1}, stages, touches,
                             {&failure, 1});
      if (touches == TouchPolicy::ignored) {
        EXPECT_EQ(failure.kind, Failure::Kind::never);
      } else {
        EXPECT_EQ(failure.kind, Failure::Kind::later);
        EXPECT_TRUE(failure.time.touch);
        EXPECT_EQ(search->sign_at(certificate, Dyadic(0.5)), 0);
      }
    }
  }
  // A plane that reaches the bead at the end, and a plane that moves with the bead.
  for (int k = 0; k < 4; ++k) motion.set_coordinate(0, k, 2, 3);
  search->set_constants({.foot = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, .normal = {{0, 0, 1}}});
  expect_all_along(*search, Above{{0}}, {3, 6, 3, 0});
  search->set_constants({.foot = {{5, 0, 3}}, .normal = {{0, 0, 1}}});
  expect_all_along(*search, Above{{0}}, {0, 0, 0, 0});
}

TEST(ConstantBeads, AllArePositiveWhereEachIs) {
  Random random(2114);
  const auto motion = test::random_motion<BezierMotion<3, 1>>(random, 20, MotionKind::generic);
  const auto search = search_over<Above>(MotionRef<3>(motion));
  search->set_constants({.foot = {{0, 0, 0.25}, {0.5, 0, -0.25}}, .normal = {{0, 0, 1}, {0.5, 0, 1}}});
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    StageCounts stages;
    for (const double time : {0.0, 0.375, 0.75}) {
      const Instant now(time);
      std::vector<Above> above, below;
      for (BeadId b = 0; b < 20; ++b)
        (search->sign_now(kernel, Above{{b}}, now, stages) > 0 ? above : below).push_back({{b}});
      ASSERT_GT(above.size(), 3U);
      ASSERT_GT(below.size(), 0U);
      EXPECT_TRUE(search->all_positive_now(kernel, above, now, stages));
      above.insert(above.begin() + 1, below[0]);
      EXPECT_FALSE(search->all_positive_now(kernel, above, now, stages));
    }
  }
}

template <Motion M>
void expect_left_of_as_judged(int rounds) {
  Random random(2112);
  for (int i = 0; i < rounds; ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("round " + std::to_string(i) + ", kind " + std::to_string(static_cast<int>(kind)));
      const auto motion = test::random_motion<M>(random, 4, kind);
      const auto search = search_over<LeftOf>(MotionRef<2>(motion));
      // The second bead is the certificate's own bead, so the function is zero.
      for (const BeadId other : {BeadId{3}, BeadId{0}}) {
        search->set_constants({.other = other});
        const auto at = [&](BeadId b, int axis) { return test::rational_coordinate(motion, b, axis); };
        expect_all_along(*search, LeftOf{{0}, random() % 2 == 0},
                         difference(product(at(other, 0), at(0, 1)), product(at(other, 1), at(0, 0))));
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(ConstantBeads, BeadsOfOnesChoiceAndPositionsAreAsJudged) {
  expect_left_of_as_judged<BezierMotion<2, 1>>(test::rounds(10));
  expect_left_of_as_judged<BezierMotion<2, 3>>(test::rounds(3));
}

TEST(ConstantBeads, PositionsNeedNoConstants) {
  Random random(2113);
  for (const MotionKind kind : test::all_motion_kinds) {
    const auto motion = test::random_motion<BezierMotion<2, 3>>(random, 3, kind);
    const auto search = search_over<Positive>(MotionRef<2>(motion));
    expect_all_along(*search, Positive{{2}}, test::rational_coordinate(motion, 2, 0));
  }
}

TEST(ConstantBeads, ABeadThatIsNoneIsRefused) {
  const BezierMotion<2, 1> motion(3);
  const auto search = search_over<LeftOf>(MotionRef<2>(motion));
  try {
    search->set_constants({.other = 3});
    ADD_FAILURE();
  } catch (const std::invalid_argument& reason) {
    EXPECT_STREQ(reason.what(), "left_of: constant 1 of 1 is no bead: expected one of 3");
  }
}

}  // namespace
}  // namespace kds::constant_beads_test
