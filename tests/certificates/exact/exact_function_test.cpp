#include "certificates/exact/exact_function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "certificates/exact/modular_gcd.h"
#include "tests/support/inputs/any_certificate.h"
#include "tests/support/inputs/random_motion.h"

namespace kds {
namespace {

using test::Random;
using test::Subject;

template <class S>
class ExactFunction : public testing::Test {};

using Subjects =
    testing::Types<Subject<Precedes, BezierMotion<1, 3>>, Subject<Orientation<2>, BezierMotion<2, 1>>,
                   Subject<Orientation<3>, BezierMotion<3, 3>>, Subject<PowerTest<2>, BezierMotion<2, 1>>,
                   Subject<PowerTest<3>, BezierMotion<3, 1>>, Subject<PowerTest<3>, BezierMotion<3, 3>>,
                   Subject<BeadInSphere<2>, BezierMotion<3, 1>>, Subject<BeadInSphere<3>, BezierMotion<3, 1>>,
                   Subject<BeadInSphere<3>, BezierMotion<3, 3>>, Subject<Contact, BezierMotion<3, 3>>>;
TYPED_TEST_SUITE(ExactFunction, Subjects);

// By residues where they reach, as is said by how many bits there are at most; and on whole numbers.
template <class C, class M>
void expect_same(const C& certificate, const M& motion) {
  constexpr Channels channels = channels_of<C>;
  const auto expected = function_of(certificate, IntegerView<M, channels>(motion, certificate.beads));
  const CoefficientBits size = coefficient_bits(function_of(C{}, MagnitudeViewOf<M>()));
  const ExactPolynomial function = exact_function_of(certificate, motion, size);
  if (function.wide() != nullptr) {  // what is known of it before its whole numbers are
    EXPECT_EQ(function.wide()->residues(), image_of(ExactPolynomial(expected).scaled()));
    const auto& leading = function.wide()->leading_digits();
    for (std::size_t k = 0; k < leading.size(); ++k) {
      if (leading[k].certain_sign() != 0) {
        EXPECT_EQ(leading[k].certain_sign(), expected.scaled[k].sign());
      }
    }
  }
  EXPECT_EQ(function.scaled(), ExactPolynomial(expected).scaled());
  // The same of the motion as curves of a degree known at run time.
  EXPECT_EQ(exact_function_of(certificate, Curves<M::dimension>(motion), size).scaled(), function.scaled());
  EXPECT_EQ(coefficient_bits(function_of(C{}, MagnitudeView<M::dimension, any_degree>(M::degree))).bits,
            size.bits);
  const int length_bits = whole_scale<channels>(motion, certificate.beads).bits + 1;
  EXPECT_LE(static_cast<int>(function.largest_bit_length()), size.bits + size.power * length_bits);
}

TYPED_TEST(ExactFunction, IsWhatWholeNumbersGive) {
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

// Every number at the end of its range, so that sums do not cancel by chance.
TYPED_TEST(ExactFunction, HoldsTheLargestCoefficients) {
  using C = typename TypeParam::C;
  using M = typename TypeParam::M;
  Random random(902);
  for (int i = 0; i < 300; ++i) {
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

// From what few primes hold to what all of them do not.
TYPED_TEST(ExactFunction, ReachesEveryWidth) {
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

TYPED_TEST(ExactFunction, OfBeadsAtTheOriginIsZero) {
  using C = typename TypeParam::C;
  Random random(904);
  const typename TypeParam::M motion(TypeParam::beads);
  const auto certificate = test::random_certificate<C>(random);
  expect_same(certificate, motion);
  EXPECT_TRUE(exact_function_of(certificate, motion, {}).is_zero());
}

}  // namespace
}  // namespace kds
