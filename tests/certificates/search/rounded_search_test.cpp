// Compares first failures of functions whose exact coefficients were rounded one by one with Sturm sequences.

#include <gtest/gtest.h>

#include <cmath>

#include "certificates/exact/rounded_polynomial.h"
#include "certificates/search/exact_search.h"
#include "tests/support/judges/judged_failure.h"
#include "tests/support/rounds.h"

namespace kds::rounded_search_test {
namespace {

using test::Scaled;
using Kind = Failure::Kind;

/// Follows a function from birth to birth at its own roots.
void follow(Scaled p, const std::string& what) {
  SCOPED_TRACE(what);
  StageCounts stages;
  test::Functions functions;
  test::JudgedTime judged_now = test::judged(0);
  Instant now(0);
  KnownAtStart known = KnownAtStart::unknown;
  for (int birth = 0; birth < 8; ++birth) {
    const ExactPolynomial function(p);
    const test::JudgedFailure expected = test::judged_failure(function, judged_now);
    const Failure failure = rounded_first_failure(function, now, known, stages, TouchPolicy::ignored);
    test::expect_confirmed("rounded", failure, function, expected);
    if (failure.time.last && failure.kind == Kind::later) {
      Scaled negated = p;
      for (Integer& x : negated) x = -x;
      EXPECT_EQ(static_cast<int>(test::judged_failure(ExactPolynomial(negated), expected.time).kind),
                static_cast<int>(Kind::never));
    }
    if (failure.kind != Kind::later || testing::Test::HasFailure()) return;
    now = Instant(failure.time, functions, functions.add(function));
    judged_now = expected.time;
    known = KnownAtStart::at_own_root;
    for (Integer& x : p) x = -x;
  }
}

TEST(RoundedSearch, FindsWhatSturmSequencesFind) {
  test::Random random(1301);
  for (int i = 0; i < test::rounds(3000) && !testing::Test::HasFailure(); ++i)
    follow(test::random_polynomial(random), "seed 1301, case " + std::to_string(i));
}

/// Makes functions that are zero at the start and almost zero at the end. Rotating lattices have such
/// functions, because their coordinates are rounded.
Scaled nearly_zero_at_ends(test::Random& random) {
  Scaled p = test::product(test::product(test::linear(0, 1), test::linear(1, 1)),
                           test::random_coefficients(random, 3, 20));
  Scaled noise = test::random_coefficients(random, 5, static_cast<unsigned>(test::pick(random, 20, 70)));
  if (random() % 2 == 0) noise.front() = 0;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = (p[k] << 80U) + noise[k];
  return p;
}

TEST(RoundedSearch, NeedsNoLongNumbersWhereFunctionsAreNearlyZeroAtTheEnds) {
  test::Random random(1302);
  int decided = 0;
  constexpr int all = test::rounds(1000);
  for (int i = 0; i < all && !testing::Test::HasFailure(); ++i) {
    const Scaled p = nearly_zero_at_ends(random);
    follow(p, "seed 1302, case " + std::to_string(i));
    const RoundedPolynomial rounded{ExactPolynomial(p)};
    decided += rounded.sign_on(0, 0) < 0 ||
               (rounded.sign_on(0, 0) > 0 &&
                rounded.first_descent(0).verdict != RoundedPolynomial::Verdict::undecided);
  }
  EXPECT_GT(decided, all * 95 / 100);
}

TEST(RoundedSearch, SignsAreThoseOfTheFunction) {
  test::Random random(1303);
  int certain = 0;
  for (int i = 0; i < 2000; ++i) {
    const Scaled p = random() % 2 == 0 ? nearly_zero_at_ends(random) : test::random_polynomial(random);
    const ExactPolynomial function(p);
    const double at =
        std::ldexp(static_cast<double>(test::pick(random, 1, 1 << 20)), -test::pick(random, 21, 60));
    for (const double time : {at, 1 - at}) {
      const int sign = RoundedPolynomial(function).sign_on(time, time);
      if (sign == 0) continue;
      ++certain;
      EXPECT_EQ(sign, function.sign_at(Dyadic(time))) << "seed 1303, case " << i;
    }
  }
  EXPECT_GT(certain, 2000);
}

// A double root is a touch. Only exact arithmetic distinguishes it from two roots or none.
TEST(RoundedSearch, DecidesNothingAtDoubleRoots) {
  const Scaled p = test::product(test::linear(1, 3), test::linear(1, 3));
  EXPECT_EQ(static_cast<int>(RoundedPolynomial(ExactPolynomial(p)).first_descent(0).verdict),
            static_cast<int>(RoundedPolynomial::Verdict::undecided));
}

}  // namespace
}  // namespace kds::rounded_search_test
