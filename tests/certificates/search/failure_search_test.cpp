#include "tests/support/searches.h"

#include <gtest/gtest.h>

#include <limits>

#include "certificates/search/exact_search.h"
#include "tests/support/inputs/any_certificate.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/judged_failure.h"
#include "tests/support/rounds.h"

namespace kds::failure_search_test {
namespace {

namespace sturm = test::sturm;
using test::JudgedTime;
using test::MotionKind;
using test::Subject;

template <class S>
class FailureSearch : public testing::Test {
 protected:
  using C = typename S::C;
  using M = typename S::M;

  // Compares both kernels with the judge, from one instant on.
  Failure expect_agreement(const C& certificate, const M& motion, const Instant& now,
                           const JudgedTime& judged_now, KnownAtStart birth, JudgedTime& judged_then) {
    const ExactPolynomial function = test::exact_function(certificate, motion);
    const test::JudgedFailure expected = test::judged_failure(function, judged_now);
    StageCounts filtered_stages;
    StageCounts exact_stages;
    const Failure filtered =
        test::first_failure(Kernel::filtered, certificate, motion, now, birth, filtered_stages);
    const Failure exact = test::first_failure(Kernel::exact, certificate, motion, now, birth, exact_stages);
    test::expect_confirmed("filtered", filtered, function, expected);
    test::expect_confirmed("exact", exact, function, expected);
    EXPECT_EQ(stage_total(filtered_stages), 1U);
    EXPECT_EQ(exact_stages.exact + exact_stages.identically_zero, 1U);
    EXPECT_EQ(exact_stages.identically_zero, function.is_zero() ? 1U : 0U);
    if (filtered.kind == Failure::Kind::later && exact.kind == Failure::Kind::later) {
      ExactTime a = exact_time(function, filtered.time);
      ExactTime b = exact_time(function, exact.time);
      EXPECT_EQ(ExactTime::compare(a, b), 0);
    }
    expect_signs(certificate, motion, now, judged_now, function);
    decided_in_double_ += 1 - filtered_stages.exact - filtered_stages.identically_zero;
    ++decided_;
    judged_then = expected.time;
    return filtered;
  }

  // Follows the whole step: a certificate, its negation at the failure, and so on.
  void expect_agreement_all_along(const C& first, const M& motion, double start) {
    C certificate = first;
    test::Functions functions;
    Instant now(start);
    JudgedTime judged_now = test::judged(start);
    KnownAtStart birth = KnownAtStart::unknown;
    for (int event = 0; event < 20; ++event) {
      JudgedTime judged_then;
      const Failure failure = expect_agreement(certificate, motion, now, judged_now, birth, judged_then);
      // Stops if the certificate never fails or its function is zero.
      if (testing::Test::HasFailure() || failure.kind <= Failure::Kind::zero) return;
      if (failure.kind == Failure::Kind::later) {
        now = Instant(failure.time, functions, functions.add(test::exact_function(certificate, motion)));
        judged_now = judged_then;
        birth = event % 3 == 2 ? KnownAtStart::unknown : KnownAtStart::at_own_root;
      }
      certificate = test::opposite(certificate);
    }
    FAIL() << "more failures than the function has roots";
  }

  // Searches another certificate from the same instant on.
  void expect_agreement_with_another(const C& first, const C& second, const M& motion) {
    test::Functions functions;
    JudgedTime then;
    const Failure failure =
        expect_agreement(first, motion, Instant(0), test::judged(0), KnownAtStart::unknown, then);
    if (testing::Test::HasFailure() || failure.kind != Failure::Kind::later) return;
    const Instant now(failure.time, functions, functions.add(test::exact_function(first, motion)));
    JudgedTime unused;
    expect_agreement(second, motion, now, then, KnownAtStart::unknown, unused);
  }

  static std::uint64_t stage_total(const StageCounts& stages) {
    return stages.coefficients + stages.isolation + stages.refined + stages.exact + stages.identically_zero;
  }

  std::uint64_t decided_in_double_ = 0;
  std::uint64_t decided_ = 0;

 private:
  void expect_signs(const C& certificate, const M& motion, const Instant& now, const JudgedTime& judged_now,
                    const ExactPolynomial& function) {
    StageCounts stages;
    sturm::Polynomial power = sturm::from_scaled(function.scaled());
    sturm::normalize(power);
    const int expected = sturm::sign_after(power, *judged_now.sequence, judged_now.root);
    EXPECT_EQ((test::sign_just_after(Kernel::filtered, certificate, motion, now, stages)), expected);
    EXPECT_EQ(stages.signs_double + stages.signs_exact, 1U);
    EXPECT_EQ((test::sign_just_after(Kernel::exact, certificate, motion, now, stages)), expected);
  }
};

using Subjects =
    testing::Types<Subject<Precedes, BezierMotion<1, 1>>, Subject<Precedes, BezierMotion<3, 3>>,
                   Subject<Orientation<3>, BezierMotion<3, 1>>, Subject<Orientation<3>, BezierMotion<3, 2>>,
                   Subject<BeadInSphere<1>, BezierMotion<3, 1>>, Subject<BeadInSphere<2>, BezierMotion<3, 1>>,
                   Subject<BeadInSphere<2>, BezierMotion<2, 3>>, Subject<BeadInSphere<3>, BezierMotion<3, 1>>,
                   Subject<BeadInSphere<3>, BezierMotion<3, 3>>, Subject<PowerTest<3>, BezierMotion<3, 1>>,
                   Subject<PowerTest<3>, BezierMotion<3, 3>>, Subject<Contact, BezierMotion<3, 1>>,
                   Subject<Contact, BezierMotion<2, 3>>>;
TYPED_TEST_SUITE(FailureSearch, Subjects);

// Uses fewer rounds for types of high degree, for which the judge is slow.
template <class S>
constexpr int rounds_of(int linear) {
  using Function = decltype(function_of(typename S::C{}, MagnitudeView<S::M::dimension, S::M::degree>{}));
  return test::rounds(Function::degree <= 6 ? linear : linear / (2 * Function::degree) + 1);
}

TYPED_TEST(FailureSearch, KernelsAndSturmAgree) {
  test::Random random(301);
  for (int i = 0; i < rounds_of<TypeParam>(15); ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      const auto motion = test::random_motion<typename TypeParam::M>(random, TypeParam::beads, kind);
      const auto certificate = test::random_certificate<typename TypeParam::C>(random);
      const double start = random() % 2   ? 0
                           : random() % 2 ? 0.25 * test::pick(random, 0, 3)
                                          : test::uniform(random, 0, 1);
      SCOPED_TRACE("seed 301, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      this->expect_agreement_all_along(certificate, motion, start);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TYPED_TEST(FailureSearch, AgreesAtOtherCertificatesTimes) {
  test::Random random(302);
  for (int i = 0; i < rounds_of<TypeParam>(30); ++i) {
    for (const MotionKind kind : {MotionKind::generic, MotionKind::grid, MotionKind::cospherical}) {
      const std::size_t beads = TypeParam::beads;
      const auto motion = test::random_motion<typename TypeParam::M>(random, beads + 1, kind);
      const auto certificate = test::random_certificate<typename TypeParam::C>(random);
      auto other = test::random_certificate<typename TypeParam::C>(random);
      for (BeadId& bead : other.beads) bead += bead == beads - 1 ? 1 : 0;  // keeps the order of the beads
      SCOPED_TRACE("seed 302, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      this->expect_agreement_with_another(certificate, other, motion);
      this->expect_agreement_with_another(certificate, test::opposite(certificate), motion);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TYPED_TEST(FailureSearch, ScaleChangesNothing) {
  test::Random random(303);
  for (int i = 0; i < rounds_of<TypeParam>(7); ++i) {
    for (const int exponent : {-1000, -300, -215, -210, -150, 150, 300, 1000}) {
      const auto kind = random() % 2 ? MotionKind::generic : MotionKind::grid;
      auto motion = test::random_motion<typename TypeParam::M>(random, TypeParam::beads, kind);
      for (BeadId b = 0; b < TypeParam::beads; ++b) {
        for (int k = 0; k <= TypeParam::M::degree; ++k) motion.set_weight(b, k, 0);
      }
      const auto certificate = test::random_certificate<typename TypeParam::C>(random);
      StageCounts stages;
      const Failure plain =
          test::first_failure(Kernel::exact, certificate, motion, Instant(0), KnownAtStart::unknown, stages);
      test::scale(motion, exponent);
      SCOPED_TRACE("seed 303, round " + std::to_string(i) + ", times 2^" + std::to_string(exponent));
      this->expect_agreement_all_along(certificate, motion, 0);
      if (testing::Test::HasFailure()) return;
      if (exponent > -900) {  // at smaller scales low bits are lost
        const Failure scaled = test::first_failure(Kernel::exact, certificate, motion, Instant(0),
                                                   KnownAtStart::unknown, stages);
        EXPECT_EQ(scaled.kind, plain.kind);
        EXPECT_EQ(scaled.time.lower, plain.time.lower);
        EXPECT_EQ(scaled.time.upper, plain.time.upper);
      }
    }
  }
}

// Tracked errors have no range limits: certificates that doubles decide at one scale they decide at all
// scales.
TYPED_TEST(FailureSearch, NoScaleIsLeftToIntegers) {
  test::Random random(306);
  StageCounts plain, scaled;
  for (int i = 0; i < rounds_of<TypeParam>(20); ++i) {
    auto motion = test::random_motion<typename TypeParam::M>(random, TypeParam::beads, MotionKind::generic);
    for (BeadId b = 0; b < TypeParam::beads; ++b) {
      for (int k = 0; k <= TypeParam::M::degree; ++k) motion.set_weight(b, k, 0);
    }
    const auto certificate = test::random_certificate<typename TypeParam::C>(random);
    const Failure::Kind kind =
        test::first_failure(Kernel::filtered, certificate, motion, Instant(0), KnownAtStart::unknown, plain)
            .kind;
    const int sign = test::sign_now(Kernel::filtered, certificate, motion, Instant(0.5), plain);
    int before = 0;
    for (const int exponent : {-1000, -600, -300, -150, 150, 300, 600, 1000}) {
      SCOPED_TRACE("seed 306, round " + std::to_string(i) + ", times 2^" + std::to_string(exponent));
      test::scale(motion, exponent - before);
      before = exponent;
      EXPECT_EQ(test::first_failure(Kernel::filtered, certificate, motion, Instant(0), KnownAtStart::unknown,
                                    scaled)
                    .kind,
                kind);
      EXPECT_EQ(test::sign_now(Kernel::filtered, certificate, motion, Instant(0.5), scaled), sign);
    }
  }
  EXPECT_LE(scaled.exact, 8 * plain.exact + 1);
  EXPECT_LE(scaled.signs_exact, 8 * plain.signs_exact + 1);
}

TEST(FailureTimes, KeepThatTheyAreATouch) {
  const ExactPolynomial function({Integer(1), Integer(-3)});
  ExactFailure at_a_change{ExactTime(function, {Dyadic(0.125), Dyadic(0.5)}), true};
  const Failure failure = to_failure(function, at_a_change);
  EXPECT_TRUE(failure.time.isolating);
  EXPECT_TRUE(failure.time.touch);
}

// Scales at which values of the function, or intermediate products, are subnormal.
TYPED_TEST(FailureSearch, UnderflowNeverMisleads) {
  test::Random random(304);
  const int power =
      function_of(typename TypeParam::C{}, MagnitudeViewOf<typename TypeParam::M>()).scaled[0].power;
  for (int i = 0; i < rounds_of<TypeParam>(90); ++i) {
    auto motion = test::random_motion<typename TypeParam::M>(
        random, TypeParam::beads, random() % 2 ? MotionKind::generic : MotionKind::grid);
    test::scale(motion, -test::pick(random, 1040 / power, 1076 / power));
    const auto certificate = test::random_certificate<typename TypeParam::C>(random);
    SCOPED_TRACE("seed 304, round " + std::to_string(i));
    this->expect_agreement_all_along(certificate, motion, 0);
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(FailureSearch, GenericMotionIsSettledInDouble) {
  test::Random random(305);
  for (int i = 0; i < rounds_of<TypeParam>(60); ++i) {
    const auto motion =
        test::random_motion<typename TypeParam::M>(random, TypeParam::beads, MotionKind::generic);
    const auto certificate = test::random_certificate<typename TypeParam::C>(random);
    StageCounts stages;
    Instant now(0);
    const auto positive = test::sign_just_after(Kernel::filtered, certificate, motion, now, stages) > 0
                              ? certificate
                              : test::opposite(certificate);
    JudgedTime unused;
    this->expect_agreement(positive, motion, now, test::judged(0), KnownAtStart::unknown, unused);
  }
  EXPECT_GE(this->decided_in_double_ * 20, this->decided_ * 19);
}

// After its last root a function keeps its sign until the end of the step, and needs no search.
TEST(LastRoot, IsToldWhereNoOtherFollows) {
  struct Curve {
    std::array<double, 4> control;
    bool last;  // the first root is the last one
  };
  for (const Curve& curve :
       {Curve{{1, 0.5, -0.5, -1}, true}, Curve{{1, -1, -1, -0.5}, true}, Curve{{1, -1, -1, 1}, false},
        Curve{{1, -2, 2, -1}, false}, Curve{{1, 0.25, -0.5, 0}, false}}) {
    BezierMotion<1, 3> motion(2);
    for (int k = 0; k <= 3; ++k) motion.set_coordinate(1, k, 0, curve.control[static_cast<std::size_t>(k)]);
    const Precedes before({0, 1});
    Precedes after = before;
    after.sign = -after.sign;
    StageCounts stages;
    const Failure first =
        test::first_failure(Kernel::filtered, before, motion, Instant(0.0), KnownAtStart::unknown, stages);
    ASSERT_EQ(first.kind, Failure::Kind::later);
    EXPECT_EQ(first.time.last, curve.last);
    test::Functions functions;
    const Instant now(first.time, functions, functions.add(test::exact_function(before, motion)));
    const Failure next =
        test::first_failure(Kernel::filtered, after, motion, now, KnownAtStart::at_own_root, stages);
    if (curve.last) {
      EXPECT_EQ(next.kind, Failure::Kind::never);
    }
  }
}

}  // namespace
}  // namespace kds::failure_search_test
