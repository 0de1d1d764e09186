#include "certificates/formulas/function_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "certificates/exact/exact_work.h"
#include "certificates/exact/polynomial_gcd.h"
#include "certificates/exact/recent_functions.h"
#include "certificates/exact/wide_polynomial.h"
#include "certificates/types/bead_in_sphere.h"
#include "certificates/types/reaches_further.h"
#include "motions/curves/lifted_motion.h"
#include "motions/views/integer_view.h"
#include "tests/support/inputs/any_certificate.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::formula_in_integers_test {
namespace {

using test::Random;
using test::Subject;

template <class S>
class FormulaInIntegers : public testing::Test {};

using Subjects =
    testing::Types<Subject<Precedes, BezierMotion<1, 3>>, Subject<Orientation<2>, BezierMotion<2, 1>>,
                   Subject<Orientation<3>, BezierMotion<3, 3>>, Subject<PowerTest<2>, BezierMotion<2, 1>>,
                   Subject<PowerTest<3>, BezierMotion<3, 1>>, Subject<PowerTest<3>, BezierMotion<3, 3>>,
                   Subject<PowerTest<2>, LiftedMotion<2>>, Subject<PowerTest<3>, LiftedMotion<3>>,
                   Subject<BeadInSphere<2>, BezierMotion<3, 1>>, Subject<BeadInSphere<3>, BezierMotion<3, 1>>,
                   Subject<BeadInSphere<3>, BezierMotion<3, 3>>, Subject<Contact, BezierMotion<3, 3>>>;
TYPED_TEST_SUITE(FormulaInIntegers, Subjects);

// Compares the replayed formula with the formula itself over integers. The replay uses residues if the bound
// on the number of bits allows.
template <class C, class M>
void expect_same(const C& certificate, const M& motion) {
  using Values = FunctionValues<C, CurvesOf<M>>;
  constexpr Channels channels = channels_of<C>;
  const auto expected = function_of(certificate, IntegerView<M>(motion, certificate.beads, channels));
  const CoefficientBits& size = detail::known_formula<C, CurvesOf<M>>().coefficient_bits(M::degree);
  const ExactPolynomial function = Values::exact(certificate, CurvesOf<M>(motion));
  if (function.wide() != nullptr) {  // facts that are known before the integer coefficients are
    EXPECT_EQ(function.wide()->residues(), image_of(ExactPolynomial(expected).scaled()));
    const auto& leading = function.wide()->balls();
    for (std::size_t k = 0; k < leading.size(); ++k) {
      if (leading[k].certain_sign() != 0) {
        EXPECT_EQ(leading[k].certain_sign(), sgn(expected.scaled[k]));
      }
    }
  }
  EXPECT_EQ(function.scaled(), ExactPolynomial(expected).scaled());
  const Dyadic time(0.375);
  const auto then = function_of(certificate, MomentView<M>(motion, certificate.beads, time, channels));
  EXPECT_EQ(Values::sign_at(certificate, CurvesOf<M>(motion), time), sgn(then.scaled[0]));
  const int length_bits = whole_scale(motion, certificate.beads, channels).bits + 1;
  EXPECT_LE(static_cast<int>(function.largest_bit_length()), size.bits + size.power * length_bits);
}

TYPED_TEST(FormulaInIntegers, IsWhatWholeNumbersGive) {
  using C = typename TypeParam::C;
  using M = typename TypeParam::M;
  Random random(901);
  for (const test::MotionKind kind : test::all_motion_kinds) {
    for (int i = 0; i < 20; ++i) {
      auto motion = test::random_motion<M>(random, TypeParam::beads, kind);
      expect_same(test::random_certificate<C>(random), motion);
      test::scale(motion, test::pick(random, -400, 400));
      expect_same(test::random_certificate<C>(random), motion);
    }
  }
}

// Every number is at the end of its range, so that sums do not cancel by chance.
TYPED_TEST(FormulaInIntegers, HoldsTheLargestCoefficients) {
  using C = typename TypeParam::C;
  using M = typename TypeParam::M;
  Random random(902);
  for (int i = 0; i < test::rounds(300); ++i) {
    M motion(TypeParam::beads);
    const int bits = test::pick(random, 1, 53);
    const double most = std::ldexp(1.0, bits) - 1;
    const auto extreme = [&] { return random() % 2 ? most : -most; };
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      for (int k = 0; k <= M::degree; ++k) {
        for (int axis = 0; axis < M::dimension; ++axis) motion.set_coordinate(b, k, axis, extreme());
        motion.set_weight(b, k, random() % 2 ? most * most : 0);
        motion.set_radius(b, k, most);
      }
    }
    expect_same(test::random_certificate<C>(random), motion);
  }
}

// The widths range from numbers that need few primes to numbers that exceed all primes.
TYPED_TEST(FormulaInIntegers, ReachesEveryWidth) {
  using C = typename TypeParam::C;
  using M = typename TypeParam::M;
  Random random(903);
  for (int spread = 0; spread <= 1000; spread += test::pick(random, 1, 25)) {
    M motion(TypeParam::beads);
    const auto number = [&](int exponent) {
      return std::ldexp(test::uniform(random), test::pick(random, -exponent, exponent));
    };
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      for (int k = 0; k <= M::degree; ++k) {
        for (int axis = 0; axis < M::dimension; ++axis) motion.set_coordinate(b, k, axis, number(spread));
        motion.set_weight(b, k, std::abs(number(spread)));
        motion.set_radius(b, k, std::abs(number(spread)));
      }
    }
    motion.set_coordinate(0, 0, 0, std::ldexp(1.0, spread));
    motion.set_coordinate(1, 0, 0, std::ldexp(1.0, -spread));
    expect_same(test::random_certificate<C>(random), motion);
  }
}

// Coefficients are cached by the numbers of the beads, whichever beads have these numbers, and are not used
// for other numbers.
TYPED_TEST(FormulaInIntegers, IsThatOfTheNumbersItIsAskedOf) {
  using C = typename TypeParam::C;
  using M = typename TypeParam::M;
  Random random(906);
  ExactWork account;
  const ExactWork::Open open(account);
  for (int i = 0; i < 30; ++i) {
    auto motion = test::random_motion<M>(random, TypeParam::beads, test::MotionKind::generic);
    const auto certificate = test::random_certificate<C>(random);
    expect_same(certificate, motion);
    const std::uint64_t first = account.done();
    expect_same(certificate, motion);
    EXPECT_LT(account.done() - first, 100U);  // the coefficients were not computed again
    const auto bead = certificate.beads[0];
    motion.set_coordinate(bead, M::degree, 0, motion.coordinate(bead, M::degree, 0) + 1);
    expect_same(certificate, motion);
    for (BeadId b = 0; b < motion.bead_count(); ++b)
      for (int k = 0; k <= M::degree; ++k) motion.set_coordinate(b, k, 0, -motion.coordinate(b, k, 0));
    expect_same(certificate, motion);
  }
}

TEST(RecentCoefficients, AreKnownByFormulaAndEveryNumber) {
  RecentCoefficients recent;
  const int a = 0, b = 0;
  const std::vector<double> numbers{1, 0, 2}, others{1, -0.0, 2}, more{1, 0, 2, 0};
  const std::vector<Integer> coefficients{Integer(3), Integer(-4)};
  EXPECT_EQ(recent.of({&a, numbers}), nullptr);
  recent.keep({&a, numbers}, coefficients);
  ASSERT_NE(recent.of({&a, numbers}), nullptr);
  EXPECT_EQ(*recent.of({&a, numbers}), coefficients);
  EXPECT_EQ(recent.of({&b, numbers}), nullptr);
  EXPECT_EQ(recent.of({&a, others}), nullptr);
  EXPECT_EQ(recent.of({&a, more}), nullptr);
  EXPECT_EQ(recent.of({&a, {}}), nullptr);
  recent.keep({&b, numbers}, {Integer(5)});  // the same cache entry
  EXPECT_EQ(recent.of({&a, numbers}), nullptr);
  ASSERT_NE(recent.of({&b, numbers}), nullptr);
  EXPECT_EQ(*recent.of({&b, numbers}), std::vector<Integer>{Integer(5)});
}

TYPED_TEST(FormulaInIntegers, OfBeadsAtTheOriginIsZero) {
  using C = typename TypeParam::C;
  Random random(904);
  const typename TypeParam::M motion(TypeParam::beads);
  const auto certificate = test::random_certificate<C>(random);
  expect_same(certificate, motion);
  using Values = FunctionValues<C, CurvesOf<typename TypeParam::M>>;
  EXPECT_TRUE(Values::exact(certificate, CurvesOf<typename TypeParam::M>(motion)).is_zero());
}

// Functions with numbers of their own, including wide functions, whose digits are cached.
TEST(FormulaInIntegers, OfDirectedBeadsKnowsTheirDirection) {
  Random random(905);
  for (int i = 0; i < test::rounds(100); ++i) {
    auto motion = test::random_motion<BezierMotion<3, 1>>(random, 2, test::MotionKind::generic);
    if (i % 2 == 0) motion.set_coordinate(0, 0, 0, 0x1p-300);
    for (const SlabDirection& direction :
         {SlabDirection{{1, 1, 0}}, SlabDirection{{1, 0, -1}}, SlabDirection{{1, 1, 0}}})
      expect_same(ReachesFurther(1, 0, direction), motion);
  }
}

/// A function whose formula branches on its direction, which types must not do.
struct BranchesOnItsDirection {
  DirectedBeads beads{};

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const DirectedBeads& beads) {
    const auto d = view.difference(beads[1], beads[0]);
    return beads.direction.steps[0] == 0 ? d[1] + d[2] : d[1] - d[2];
  }
};

// Without this refusal the second function would get the coefficients of the first.
TEST(FormulaInIntegers, TypesWhoseFormulasBranchAreRefused) {
  Random random(907);
  using M = BezierMotion<3, 1>;
  using Values = FunctionValues<BranchesOnItsDirection, Curves<3>>;
  M motion = test::random_motion<M>(random, 2, test::MotionKind::generic);
  for (const double length : {1.0, 0x1p-300}) {  // ordinary and wide
    motion.set_coordinate(0, 0, 0, length);
    const CurvesOf<M> curves(motion);
    BranchesOnItsDirection function{{{0, 1}, {{1, 1, 1}}}};
    EXPECT_NO_THROW(static_cast<void>(Values::exact(function, curves)));
    function.beads.direction = {{1, 0, 1}};
    EXPECT_NO_THROW(static_cast<void>(Values::exact(function, curves)));
    function.beads.direction = {{0, 1, 1}};
    EXPECT_THROW(static_cast<void>(Values::exact(function, curves)), std::logic_error);
  }
}

}  // namespace
}  // namespace kds::formula_in_integers_test
