#include "certificates/filters/bounded_polynomial.h"

#include <gtest/gtest.h>

#include "certificates/formulas/function_values.h"
#include "motions/views/integer_view.h"
#include "tests/support/inputs/any_certificate.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::error_bound_test {
namespace {

using test::MotionKind;
using test::Subject;

/// Returns the bound that searches derive, over curves of the motion's degree.
template <class C, class M>
const ErrorBound& bound_of() {
  return FunctionValues<C, Curves<M::dimension>>::error_bound(M::degree);
}

template <class S>
class ErrorBounds : public testing::Test {
 protected:
  using C = typename S::C;
  using M = typename S::M;

  // Returns the largest |double - exact| / bound among the coefficients.
  static double share_used(const C& certificate, const M& motion) {
    const DoubleView<M> view(motion);
    const auto rounded = function_of(certificate, view);
    const auto exact = function_of(certificate, IntegerView<M>(motion, certificate.beads));
    const ErrorBound& bound = bound_of<C, M>();
    const double scale = bound.scale(view.largest_length());
    if (std::isnan(scale)) return 0;
    const int shift = whole_scale(motion, certificate.beads).exponent * bound.power;
    const Integer power = Integer(1) << static_cast<unsigned>(std::abs(shift));
    double share = 0;
    for (std::size_t k = 0; k < rounded.scaled.size(); ++k) {
      const Rational value = shift > 0 ? fraction(exact.scaled[k], power) : Rational(exact.scaled[k] * power);
      const Rational error = abs(Dyadic(rounded.scaled[k]).rational() - value);
      share = std::max(share, Rational(error / Dyadic(bound.coefficient[k] * scale).rational()).get_d());
      // checks also the plain coefficient, which is divided by its binomial
      const auto choose =
          static_cast<double>(binomial(static_cast<int>(rounded.scaled.size()) - 1, static_cast<int>(k)));
      const Rational plain = abs(Dyadic(rounded.scaled[k] / choose).rational() - value / Rational(choose));
      EXPECT_LE(plain, Dyadic(bound.uniform * scale).rational());
    }
    return share;
  }
};

using Subjects =
    testing::Types<Subject<Precedes, BezierMotion<1, 1>>, Subject<Precedes, BezierMotion<3, 3>>,
                   Subject<Orientation<3>, BezierMotion<3, 1>>, Subject<Orientation<3>, BezierMotion<3, 3>>,
                   Subject<BeadInSphere<1>, BezierMotion<3, 1>>, Subject<BeadInSphere<2>, BezierMotion<3, 1>>,
                   Subject<BeadInSphere<2>, BezierMotion<2, 2>>, Subject<BeadInSphere<3>, BezierMotion<3, 1>>,
                   Subject<BeadInSphere<3>, BezierMotion<3, 3>>, Subject<PowerTest<3>, BezierMotion<3, 1>>,
                   Subject<PowerTest<3>, BezierMotion<3, 3>>, Subject<Contact, BezierMotion<3, 1>>,
                   Subject<Contact, BezierMotion<2, 3>>>;
TYPED_TEST_SUITE(ErrorBounds, Subjects);

TYPED_TEST(ErrorBounds, HoldAtAllScales) {
  test::Random random(601);
  for (int i = 0; i < test::rounds(60); ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      auto motion = test::random_motion<typename TypeParam::M>(random, TypeParam::beads, kind);
      test::scale(motion, test::pick(random, -180, 180));
      if (random() % 4 == 0) {  // the weight of one bead is much larger than its squared distance
        for (int k = 0; k <= TypeParam::M::degree; ++k)
          motion.set_weight(0, k, std::ldexp(1.0, test::pick(random, -300, 300)));
      }
      const auto certificate = test::random_certificate<typename TypeParam::C>(random);
      EXPECT_LE(this->share_used(certificate, motion), 1)
          << "seed 601, round " << i << ", kind " << static_cast<int>(kind);
    }
  }
}

// Random input uses a fair share of the bound, so the bound has the right size.
TYPED_TEST(ErrorBounds, AreNotAbsurd) {
  test::Random random(602);
  double share = 0;
  for (int i = 0; i < test::rounds(1000); ++i) {
    auto motion = test::random_motion<typename TypeParam::M>(random, TypeParam::beads, MotionKind::generic);
    for (BeadId b = 0; b < TypeParam::beads;
         ++b) {  // approximately corners of a cube, so that all differences have similar sizes
      for (int k = 0; k <= TypeParam::M::degree; ++k) {
        for (int axis = 0; axis < TypeParam::M::dimension; ++axis) {
          const double x = motion.coordinate(b, k, axis);
          motion.set_coordinate(b, k, axis, (x < 0 ? -1 : 1) + 0x1p-10 * x);
        }
      }
    }
    const auto certificate = test::random_certificate<typename TypeParam::C>(random);
    share = std::max(share, this->share_used(certificate, motion));
  }
  EXPECT_GT(share, 1e-3);
  EXPECT_LT((bound_of<typename TypeParam::C, typename TypeParam::M>().uniform), 1e-9);
}

TYPED_TEST(ErrorBounds, SayNothingOutOfRange) {
  const ErrorBound& bound = bound_of<typename TypeParam::C, typename TypeParam::M>();
  EXPECT_GE(bound.power, 1);
  EXPECT_EQ(bound.scale(2), std::ldexp(1.0, bound.power));
  EXPECT_TRUE(std::isnan(bound.scale(0)));
  EXPECT_TRUE(std::isnan(bound.scale(0x1p-901)));
  EXPECT_TRUE(std::isnan(bound.scale(0x1p901)));
  EXPECT_TRUE(std::isnan(bound.scale(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(bound.scale(std::nan(""))));
}

TEST(ErrorBound, KnowsTheDegreeInLengths) {
  using M = BezierMotion<3, 1>;
  EXPECT_EQ((bound_of<Precedes, M>().power), 1);
  EXPECT_EQ((bound_of<Orientation<3>, M>().power), 3);
  EXPECT_EQ((bound_of<PowerTest<3>, M>().power), 5);
  EXPECT_EQ((bound_of<Contact, M>().power), 2);
  EXPECT_EQ((bound_of<BeadInSphere<1>, M>().power), 2);
  EXPECT_EQ((bound_of<BeadInSphere<2>, M>().power), 2);
  EXPECT_EQ((bound_of<BeadInSphere<3>, M>().power), 6);
}

// Checks the claimed rounding errors of evaluation and subdivision against exact values.
TEST(ErrorBound, CoversEvaluation) {
  EXPECT_GE(value_rounding(5), 12 * 5 * 0x1p-53);
  EXPECT_GE(local_rounding(5), (subdivisions + 2) * value_rounding(5));
  EXPECT_LT(local_rounding(18), 1e-11);
}

}  // namespace
}  // namespace kds::error_bound_test
