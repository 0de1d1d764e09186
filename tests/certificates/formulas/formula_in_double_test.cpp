#include "certificates/formulas/function_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "certificates/filters/tracked_moment.h"
#include "certificates/search/define_certificate_search.h"
#include "certificates/types/ball_in_sphere.h"
#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/orientation.h"
#include "certificates/types/reaches_further.h"
#include "motions/curves/lifted_motion.h"
#include "tests/support/inputs/any_certificate.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::formula_in_double_test {
namespace {

using test::Random;
using test::Subject;

template <class S>
class FormulaInDouble : public testing::Test {};

using Subjects =
    testing::Types<Subject<Precedes, BezierMotion<1, 3>>, Subject<Orientation<2>, BezierMotion<2, 1>>,
                   Subject<PowerTest<2>, BezierMotion<2, 2>>, Subject<PowerTest<3>, BezierMotion<3, 1>>,
                   Subject<PowerTest<2>, LiftedMotion<2>>, Subject<PowerTest<3>, LiftedMotion<3>>,
                   Subject<BeadInSphere<3>, BezierMotion<3, 3>>, Subject<Contact, BezierMotion<3, 1>>,
                   Subject<CentroidInside<3>, BezierMotion<3, 1>>,
                   Subject<BallReachesFurther::Radical::Norm, BezierMotion<3, 1>>,
                   Subject<BallInSphere<3, 4>::Radical::Norm, BezierMotion<3, 1>>>;
TYPED_TEST_SUITE(FormulaInDouble, Subjects);

void expect_same(double a, double b) {
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " " << b;
}

// Replaying a recorded formula gives the same bits as evaluating the formula over a view.
TYPED_TEST(FormulaInDouble, IsWhatTheFormulaGives) {
  using F = typename TypeParam::C;
  using M = typename TypeParam::M;
  using C = CurvesOf<M>;
  using Values = FunctionValues<F, C>;
  Random random(911);
  int certain = 0;
  for (const test::MotionKind kind : test::all_motion_kinds) {
    for (int i = 0; i < 20; ++i) {
      auto motion = test::random_motion<M>(random, TypeParam::beads, kind);
      if (i % 2 == 0) test::scale(motion, test::pick(random, -400, 400));
      F function;
      if constexpr (requires { function.beads.direction; }) {
        std::iota(function.beads.begin(), function.beads.end(), BeadId{0});
        function.beads.direction.steps = {1, static_cast<std::int8_t>(i % 3 - 1), 0};
      } else {
        function = test::random_certificate<F>(random);
      }

      const DoubleView<M> view(motion);
      const auto rounded = function_of(function, view);
      const ErrorBound& bound = Values::error_bound(M::degree);
      const BoundedFunction expected = bounded_function(rounded.scaled, bound, view.largest_length());
      const BoundedFunction bounded = Values::bounded(function, C(motion));
      EXPECT_EQ(bounded.positive, expected.positive);
      const auto tracked = function_of(function, TrackedView<M>(motion, function.beads, channels_of<F>));
      const BoundedFunction followed = Values::tracked(function, C(motion));
      const int degree = static_cast<int>(rounded.scaled.size()) - 1;
      ASSERT_EQ(bounded.polynomial.degree(), degree);
      ASSERT_EQ(followed.polynomial.degree(), degree);
      for (std::size_t k = 0; k < rounded.scaled.size(); ++k) {
        const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
        expect_same(bounded.polynomial.bernstein[k], rounded.scaled[k] / choose);
        expect_same(followed.polynomial.bernstein[k], tracked.scaled[k].value / choose);
        EXPECT_FALSE(followed.polynomial.value_error < tracked.scaled[k].error / choose);
      }

      if constexpr (!lifted<M> || !channels_of<F>.weights) {
        const double lower = test::uniform(random, 0, 1), upper = std::min(1.0, lower + 0x1p-10);
        const TrackedMoment<C> moment(C(motion), function.beads, lower, upper, channels_of<F>);
        F of_places = function;
        std::iota(of_places.beads.begin(), of_places.beads.end(), BeadId{0});
        const int sign = certain_sign(function_of(of_places, moment).scaled[0]);
        EXPECT_EQ(Values::sign_during(function, C(motion), lower, upper), sign);
        certain += sign != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_TRUE(lifted<M> || certain > 20) << certain;
}

// The bounds that are derived for a run-time degree equal the bounds of the formula itself.
TYPED_TEST(FormulaInDouble, BoundsAreThoseOfTheFormula) {
  using F = typename TypeParam::C;
  using M = typename TypeParam::M;
  const auto magnitudes = function_of(F{}, MagnitudeViewOf<M>());
  const ErrorBound& bound = FunctionValues<F, CurvesOf<M>>::error_bound(M::degree);
  ASSERT_EQ(bound.coefficient.size(), magnitudes.scaled.size());
  for (std::size_t k = 0; k < magnitudes.scaled.size(); ++k) {
    EXPECT_EQ(bound.power, magnitudes.scaled[k].power);
    EXPECT_NEAR(bound.coefficient[k] / magnitudes.scaled[k].error, 1, 1e-9);
    EXPECT_GE(bound.coefficient[k], magnitudes.scaled[k].error);
  }
}

/// Positive while the distance of two beads is less than three times the distance of two others.
struct ThreeTimesAsFar {
  static constexpr CertificateType type{1717, "three_times_as_far"};
  std::array<BeadId, 4> beads{};
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] static bool side() { return true; }
  template <MotionView View>
  static constexpr auto formula(const View& view, const std::array<BeadId, 4>& beads) {
    const auto near = view.difference(beads[1], beads[0]), far = view.difference(beads[3], beads[2]);
    return times(9, dot(near, near)) - dot(far, far);
  }
};
static_assert(HasStaticFormula<ThreeTimesAsFar, 3> && !AddsUnlikePowers<ThreeTimesAsFar, 3>);

TEST(BeadFunction, WholeMultiplesAreNumbersOfNoLength) {
  BezierMotion<3, 1> motion(4);
  for (const int k : {0, 1}) {
    motion.set_coordinate(1, k, 0, 1);
    motion.set_coordinate(3, k, 0, k == 0 ? 2 : 4);
  }
  const auto search = search_over<ThreeTimesAsFar>(MotionRef<3>(motion));
  const ThreeTimesAsFar certificate{{0, 1, 2, 3}};
  EXPECT_EQ(search->sign_at(certificate, Dyadic(0.5)), 0);
  EXPECT_EQ(search->sign_at(certificate, Dyadic(0.25)), 1);
  EXPECT_EQ(search->sign_at(certificate, Dyadic(0.75)), -1);
}

struct TooManyTimesAsFar {
  std::array<BeadId, 2> beads{};
  template <MotionView View>
  static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    return times((std::int64_t{1} << 53) + 1, view.difference(beads[0], beads[1])[0]);
  }
};

TEST(BeadFunction, AMultipleThatNoDoubleHoldsIsRefused) {
  EXPECT_THROW(static_cast<void>(FunctionValues<TooManyTimesAsFar, Curves<2>>::error_bound(1)),
               std::invalid_argument);
}

struct UnsetPolynomial {
  std::array<BeadId, 2> beads{};
  template <MotionView View>
  static auto formula(const View& view, const std::array<BeadId, 2>& beads) {
    auto sum = view.difference(beads[0], beads[1])[0];
    decltype(sum) unset{};
    return sum + unset;
  }
};

TEST(BeadFunction, APolynomialThatWasNeverSetIsAnError) {
  const BezierMotion<2, 1> motion(2);
  EXPECT_THROW(static_cast<void>(FunctionValues<UnsetPolynomial, Curves<2>>::error_bound(1)),
               std::logic_error);
}

}  // namespace
}  // namespace kds::formula_in_double_test
