// Known functions at known times: the result at birth, at touches and at the ends of a step, and the stage
// that decides it.
#include <gtest/gtest.h>

#include "certificates/search/exact_search.h"
#include "certificates/types/orientation.h"
#include "certificates/types/precedes.h"
#include "tests/support/judges/judged_failure.h"
#include "tests/support/searches.h"

namespace kds::births_test {
namespace {

using Kind = Failure::Kind;

// Bead 1 moves on the Bezier curve with these control points and bead 0 rests at the origin, so the function
// of "0 precedes 1" is that curve.
template <int Degree>
BezierMotion<1, Degree> curve(const std::array<double, Degree + 1>& control_points) {
  BezierMotion<1, Degree> motion(2);
  for (int k = 0; k <= Degree; ++k)
    motion.set_coordinate(1, k, 0, control_points[static_cast<std::size_t>(k)]);
  return motion;
}
const Precedes ahead{{0, 1}};
const Precedes behind{{1, 0}};

template <class M>
Failure first(Kernel kernel, const M& motion, double now, StageCounts& stages,
              const Precedes& certificate = ahead) {
  return test::first_failure(kernel, certificate, motion, Instant(now), KnownAtStart::unknown, stages);
}

// Returns the kind on which both kernels agree.
template <class M>
Failure agreed(const M& motion, double now = 0, const Precedes& certificate = ahead) {
  StageCounts stages;
  const Failure filtered = first(Kernel::filtered, motion, now, stages, certificate);
  const Failure exact = first(Kernel::exact, motion, now, stages, certificate);
  EXPECT_EQ(static_cast<int>(filtered.kind), static_cast<int>(exact.kind));
  return exact;
}

TEST(Births, VanishingAtTheStart) {
  EXPECT_EQ(agreed(curve<1>({0, 1})).kind, Kind::never);
  EXPECT_EQ(agreed(curve<1>({0, -1})).kind, Kind::at_birth);
  EXPECT_EQ(agreed(curve<2>({0, 0, 1})).kind, Kind::never);
  EXPECT_EQ(agreed(curve<2>({0, 0, -1})).kind, Kind::at_birth);
  EXPECT_EQ(agreed(curve<3>({0, 0, 0, -1})).kind, Kind::at_birth);
  EXPECT_EQ(agreed(curve<2>({0, 1, -1})).kind, Kind::later);
  EXPECT_EQ(agreed(curve<3>({0, -1, 1, 1})).kind, Kind::at_birth);
  EXPECT_EQ(agreed(curve<1>({-1, 1})).kind, Kind::at_birth);
  EXPECT_EQ(agreed(curve<1>({-1, 1}), 0.5).kind, Kind::never);  // zero at this time, positive afterwards
  EXPECT_EQ(agreed(curve<1>({1, -1}), 0.5).kind, Kind::at_birth);
}

TEST(Births, TheEndBelongsToTheNextStep) {
  EXPECT_EQ(agreed(curve<1>({1, 0})).kind, Kind::never);
  EXPECT_EQ(agreed(curve<2>({1, 1, 0})).kind, Kind::never);
  EXPECT_EQ(agreed(curve<2>({1, -1, 0})).kind, Kind::later);  // (1-u)(1-3u)
  EXPECT_EQ(agreed(curve<3>({1, -1, 0, 0})).kind, Kind::later);
  EXPECT_EQ(agreed(curve<1>({1, -0x1p-1074})).kind, Kind::later);  // just before the end
}

TEST(Births, TouchingIsNoFailure) {
  EXPECT_EQ(agreed(curve<2>({1, -1, 1})).kind, Kind::never);  // (1-2u)^2
  EXPECT_EQ(agreed(curve<2>({1, -2, 4})).kind, Kind::never);  // (1-3u)^2
  EXPECT_EQ(agreed(curve<2>({1, std::nextafter(-2, -3), 4})).kind, Kind::later);
  EXPECT_EQ(agreed(curve<2>({1, std::nextafter(-2, 0), 4})).kind, Kind::never);
  EXPECT_EQ(agreed(curve<3>({1, -1, 1, -1})).kind, Kind::later);  // (1-2u)^3, which crosses zero
  EXPECT_EQ(agreed(curve<2>({1, -1, 1}), 0.5).kind, Kind::never);
  EXPECT_EQ(agreed(curve<2>({1, -1, 1}), 0.5, behind).kind, Kind::at_birth);
  EXPECT_EQ(agreed(curve<2>({1, -1, 1}), 0, behind).kind, Kind::at_birth);
}

TEST(Births, ZeroForeverNeverFails) {
  for (const double now : {0.0, 0.375}) {
    EXPECT_EQ(agreed(curve<1>({0, 0}), now).kind, Kind::zero);
    EXPECT_EQ(agreed(curve<3>({0, 0, 0, 0}), now, behind).kind, Kind::zero);
  }
  StageCounts stages;
  EXPECT_EQ((test::sign_just_after(Kernel::filtered, ahead, curve<1>({0, 0}), Instant(0), stages)), 0);
  EXPECT_EQ((test::sign_just_after(Kernel::exact, ahead, curve<1>({0, 0}), Instant(0), stages)), 0);
}

TEST(Births, FailsAtADouble) {
  const Failure failure = agreed(curve<1>({1, -1}));
  EXPECT_LE(failure.time.lower, 0.5);
  EXPECT_GE(failure.time.upper, 0.5);
  EXPECT_LE(failure.time.upper - failure.time.lower, 0x1p-40);
}

// Alternates between a certificate and its negation: the one that is born at the other's failure waits for
// the next root.
void expect_alternation(Kernel kernel) {
  SCOPED_TRACE(name_of(kernel));
  const auto motion = curve<3>({2, -3, 3, -1});
  test::Functions functions;
  StageCounts stages;
  Instant now(0);
  double last = 0;
  for (int event = 0; event < 3; ++event) {
    const Precedes certificate = event % 2 == 0 ? ahead : behind;
    const Failure failure =
        test::first_failure(kernel, certificate, motion, now,
                            event == 0 ? KnownAtStart::unknown : KnownAtStart::at_own_root, stages);
    ASSERT_EQ(static_cast<int>(failure.kind), static_cast<int>(Kind::later));
    EXPECT_GT(failure.time.lower, last);
    last = failure.time.upper;
    now = Instant(failure.time, functions, functions.add(test::exact_function(certificate, motion)));
  }
  const Failure end = test::first_failure(kernel, behind, motion, now, KnownAtStart::at_own_root, stages);
  EXPECT_EQ(end.kind, Kind::never);
}

TEST(Births, AtOwnRootsAlternate) {
  for (const Kernel kernel : test::all_kernels) expect_alternation(kernel);
}

TEST(Stages, CoefficientsSettleWhatIsFarFromZero) {
  StageCounts stages;
  EXPECT_EQ(first(Kernel::filtered, curve<3>({3, 1, 2, 5}), 0, stages).kind, Kind::never);
  EXPECT_EQ(stages.coefficients, 1U);
  EXPECT_EQ(stages.exact + stages.isolation + stages.refined, 0U);
}

TEST(Stages, IsolationFindsSimpleRoots) {
  StageCounts stages;
  EXPECT_EQ(first(Kernel::filtered, curve<1>({3, -1}), 0, stages).kind, Kind::later);
  EXPECT_EQ(stages.isolation, 1U);
  EXPECT_EQ(first(Kernel::filtered, curve<3>({3, -1, -1, 5}), 0, stages).kind, Kind::never);
  EXPECT_EQ(stages.isolation, 2U);
  EXPECT_EQ(stages.exact + stages.coefficients + stages.refined, 0U);
}

TEST(Stages, FollowedErrorsSettleNumbersOfUnlikeSize) {
  StageCounts stages;
  EXPECT_EQ(first(Kernel::filtered, curve<1>({1, 0x1p-60}), 0, stages).kind, Kind::never);
  EXPECT_EQ(stages.refined, 1U);
  EXPECT_EQ(stages.exact, 0U);
}

TEST(Stages, IntegersSettleTouches) {
  StageCounts stages;
  EXPECT_EQ(first(Kernel::filtered, curve<2>({1, -1, 1}), 0, stages).kind, Kind::never);
  EXPECT_EQ(stages.exact, 1U);
  EXPECT_EQ(first(Kernel::filtered, curve<1>({0, -1}), 0, stages).kind, Kind::at_birth);
  EXPECT_EQ(stages.exact, 2U);
  EXPECT_GT(stages.largest_bits, 0U);
  EXPECT_EQ(stages.coefficients + stages.isolation + stages.refined + stages.identically_zero, 0U);
}

TEST(Stages, NothingIsToldApartFromZero) {
  StageCounts stages;
  BezierMotion<3, 1> flat(4);  // four beads moving in a plane
  for (BeadId b = 0; b < 4; ++b) {
    for (int k = 0; k <= 1; ++k) {
      flat.set_coordinate(b, k, 0, 0.1 * b + k);
      flat.set_coordinate(b, k, 1, 0.7 * (b % 2) - 0.3 * k * b);
    }
  }
  EXPECT_EQ((test::first_failure(Kernel::filtered, Orientation<3>({0, 1, 2, 3}, 1), flat, Instant(0),
                                 KnownAtStart::unknown, stages)
                 .kind),
            Kind::zero);
  EXPECT_EQ(stages.identically_zero, 1U);
  EXPECT_EQ(stages.exact, 0U);
}

TEST(Stages, TheExactKernelUsesIntegersAlone) {
  StageCounts stages;
  EXPECT_EQ(first(Kernel::exact, curve<3>({3, 1, 2, 5}), 0, stages).kind, Kind::never);
  EXPECT_EQ(stages.exact, 1U);
  EXPECT_EQ((test::sign_just_after(Kernel::exact, ahead, curve<1>({3, 1}), Instant(0), stages)), 1);
  EXPECT_EQ(stages.signs_exact, 1U);
  EXPECT_EQ(stages.signs_double, 0U);
}

TEST(Stages, SignsAreSettledInDoubleWhereTheyCanBe) {
  StageCounts stages;
  EXPECT_EQ((test::sign_just_after(Kernel::filtered, ahead, curve<1>({3, 1}), Instant(0.25), stages)), 1);
  EXPECT_EQ((test::sign_just_after(Kernel::filtered, behind, curve<1>({3, 1}), Instant(0.25), stages)), -1);
  EXPECT_EQ(stages.signs_double, 2U);
  EXPECT_EQ((test::sign_just_after(Kernel::filtered, ahead, curve<1>({1, -1}), Instant(0.5), stages)), -1);
  EXPECT_EQ(stages.signs_exact, 1U);
}

// Near the root, values in double are noise; the exact sign is known.
TEST(Births, NearATripleRoot) {
  const auto motion = curve<3>({27, -63, 147, -343});  // (3-10u)^3
  for (int i = -300; i < 300; ++i) {
    const double u = 0.3 + i * 0x1p-27;
    const bool before = 10 * Dyadic(u).rational() < 3;
    StageCounts stages;
    EXPECT_EQ((test::sign_just_after(Kernel::filtered, ahead, motion, Instant(u), stages)), before ? 1 : -1);
    EXPECT_EQ(static_cast<int>(first(Kernel::filtered, motion, u, stages).kind),
              static_cast<int>(before ? Kind::later : Kind::at_birth));
  }
}

// The present time is 3/10, known to lie in (1/4, 3/4). A function that is positive at 3/4 may have failed in
// between.
TEST(Births, InAWideBracket) {
  test::Functions functions;
  const auto slot = functions.add(ExactPolynomial(std::vector<Integer>{3, -7}));
  const Instant now({0.25, 0.75, 0, true}, functions, slot);
  const auto motion = curve<2>({24, -26, 24});  // roots 4/10 and 6/10
  StageCounts stages;
  const Failure failure =
      test::first_failure(Kernel::filtered, ahead, motion, now, KnownAtStart::unknown, stages);
  ASSERT_EQ(static_cast<int>(failure.kind), static_cast<int>(Kind::later));
  EXPECT_NEAR(failure.time.lower, 0.4, 1e-9);
}

TEST(Births, AtAnOwnRootThatIsNotAlone) {
  const auto motion = curve<3>({315, -395, 395, -315});  // roots 3/10, 5/10, 7/10
  test::Functions functions;
  const auto slot = functions.add(test::exact_function(ahead, motion));
  StageCounts stages;
  for (const std::uint16_t ordinal : {0, 1, 2}) {
    const Instant now({0.25, 0.75, ordinal, false}, functions, slot);
    const Precedes& certificate = ordinal == 1 ? ahead : behind;
    const Failure failure =
        test::first_failure(Kernel::filtered, certificate, motion, now, KnownAtStart::at_own_root, stages);
    ASSERT_EQ(static_cast<int>(failure.kind), static_cast<int>(ordinal == 2 ? Kind::never : Kind::later));
    if (ordinal < 2) {
      EXPECT_NEAR(failure.time.lower, ordinal == 0 ? 0.5 : 0.7, 1e-9);
    }
  }
}

// Three roots (2^70 + 2k) / 2^71, which are closer than doubles. A bracket of doubles identifies one of them
// by its number.
void expect_numbered(std::array<int, 3> roots) {
  const Integer s = Integer(1) << 70;
  std::vector<Integer> p{1};
  for (const int k : roots) {
    std::vector<Integer> next(p.size() + 1);
    for (std::size_t i = 0; i < p.size(); ++i) {
      next[i] += p[i] * (s + 2 * k);
      next[i + 1] -= p[i] * (s - 2 * k);
    }
    p = next;
  }
  StageCounts stages;
  test::Functions functions;
  Instant now(0);
  for (const int k : roots) {
    SCOPED_TRACE(k);
    const ExactPolynomial function(p);
    const Failure failure = exact_first_failure(function, now, stages);
    ASSERT_EQ(static_cast<int>(failure.kind), static_cast<int>(Kind::later));
    EXPECT_FALSE(failure.time.isolating);
    EXPECT_TRUE(failure.time.lower <= 0.5 && failure.time.upper >= 0.5);
    ExactTime time = exact_time(function, failure.time);
    ExactTime expected(Dyadic(s + 2 * k, 71));
    EXPECT_EQ(ExactTime::compare(time, expected), 0);
    now = Instant(failure.time, functions, functions.add(function));
    for (Integer& x : p) x = -x;
  }
  EXPECT_EQ(static_cast<int>(exact_first_failure(ExactPolynomial(p), now, stages).kind),
            static_cast<int>(Kind::never));
}

TEST(FailureTimes, NumberTheRootsOfABracket) {
  expect_numbered({-1, 0, 1});  // the middle root is a double
  // The bracket contains all three roots: positive before, negative after, but not isolating.
  expect_numbered({1, 2, 3});
}

TEST(FailureTimes, WithoutTheirRootAreRefused) {
  const ExactPolynomial function(std::vector<Integer>{1, 1});
  EXPECT_THROW((void)exact_time(function, {0.25, 0.75, 0, false}), std::logic_error);
}

}  // namespace
}  // namespace kds::births_test
