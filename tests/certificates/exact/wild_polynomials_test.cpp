// Polynomials whose coefficients have very different sizes, and roots that lie very close together, compared
// with Sturm sequences over integers.

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"
#include "certificates/exact/recent_functions.h"
#include "certificates/exact/wide_polynomial.h"
#include "certificates/exact/wide_roots.h"
#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/rounds.h"

namespace kds::wild_polynomials_test {
namespace {

namespace sturm = test::sturm;
using test::Random;
using test::Scaled;

Scaled wild(Random& random, int degree, int bits) {
  Scaled p;
  for (int k = 0; k <= degree; ++k) {
    const Integer mantissa = static_cast<std::int64_t>(random()) >> 11;
    p.push_back(random() % 6 == 0 ? Integer(0)
                                  : mantissa << static_cast<unsigned>(test::pick(random, 0, bits)));
  }
  return p;
}

// Makes roots around one number that are 2^-gap apart, times another polynomial.
Scaled cluster(Random& random, int roots, unsigned gap) {
  const Integer q = Integer(test::pick(random, 3, 100)) << gap;
  const Integer p = q / 3;
  Scaled product{Integer(1)};
  for (int i = 0; i < roots; ++i) product = test::product(product, test::linear(p + i, q));
  return test::product(product, wild(random, test::pick(random, 0, 3), 40));
}

Scaled some(Random& random) {
  return random() % 3 == 0
             ? cluster(random, test::pick(random, 2, 4), static_cast<unsigned>(test::pick(random, 10, 700)))
             : wild(random, test::pick(random, 1, 9), test::pick(random, 0, 2500));
}

ExactPolynomial wide(const Scaled& scaled) {
  return ExactPolynomial(std::make_shared<const WidePolynomial>(scaled));
}

// Returns the judge without roots at u = 1, which square-free parts drop.
sturm::Sequence judge_of(Scaled p) {
  while (p.back() == 0) p.pop_back();
  return sturm::Sequence(sturm::from_scaled(p));
}

TEST(WildPolynomials, RootsAreThoseThatSturmCounts) {
  Random random(1201);
  int found_any = 0;
  for (int i = 0; i < test::rounds(120) && !testing::Test::HasFailure(); ++i) {
    const Scaled scaled = some(random);
    const ExactPolynomial p = wide(scaled);
    if (p.is_zero()) continue;
    SCOPED_TRACE("seed 1201, case " + std::to_string(i) + ": " + test::describe(scaled));
    const sturm::Sequence judge = judge_of(scaled);
    const Dyadic lower(0.0);
    for (const Dyadic& upper : {Dyadic(0.75), Dyadic(1.0), Dyadic(Integer(1), 600)}) {
      const auto roots = isolate_roots(p.square_free(), lower, upper);
      EXPECT_EQ(static_cast<int>(roots.size()), judge.roots_on(0, upper.rational()));
      for (const RootInterval& root : roots) {
        const Dyadic &low = root.lower, &high = root.upper;
        ++found_any;
        if (low == high) {
          EXPECT_TRUE(judge.is_root(low.rational()));
        } else {
          EXPECT_EQ(judge.roots_between(low.rational(), high.rational()), 1);
          EXPECT_FALSE(judge.is_root(low.rational()) || judge.is_root(high.rational()));
        }
      }
    }
  }
  EXPECT_GT(found_any, test::rounds(100));
}

TEST(WildPolynomials, NarrowingKeepsTheRootAndTellsRootsApart) {
  Random random(1202);
  for (int i = 0; i < test::rounds(50) && !testing::Test::HasFailure(); ++i) {
    const Scaled scaled = some(random);
    const ExactPolynomial p = wide(scaled);
    if (p.is_zero()) continue;
    SCOPED_TRACE("seed 1202, case " + std::to_string(i) + ": " + test::describe(scaled));
    const sturm::Sequence judge = judge_of(scaled);
    std::vector<ExactTime> times;
    for (RootInterval& root : isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0)))
      times.emplace_back(p.square_free(), std::move(root));
    for (std::size_t t = 0; t < times.size(); ++t) {
      for (std::size_t s = 0; s < times.size(); ++s)
        EXPECT_EQ(ExactTime::compare(times[s], times[t]), s < t ? -1 : s > t ? 1 : 0);
      ExactTime time = times[t];
      time.narrow_for_doubles();
      if (time.is_dyadic()) continue;
      EXPECT_EQ(judge.roots_between(time.lower().rational(), time.upper().rational()), 1);
    }
  }
}

TEST(WildPolynomials, SignsAreThoseOfWholeNumbers) {
  Random random(1203);
  int signs_closely = 0;
  for (int i = 0; i < test::rounds(120) && !testing::Test::HasFailure(); ++i) {
    const Scaled scaled = some(random);
    const ExactPolynomial p = wide(scaled);
    SCOPED_TRACE("seed 1203, case " + std::to_string(i) + ": " + test::describe(scaled));
    const sturm::Polynomial power = sturm::from_scaled(scaled);
    const auto bits = static_cast<unsigned>(test::pick(random, 1, 900));
    const Integer third = (Integer(1) << bits) / 3;
    for (const Dyadic& u : {Dyadic(1, bits), Dyadic((Integer(1) << bits) - 1, bits), Dyadic(third, bits)})
      EXPECT_EQ(p.sign_at(u), sturm::sign_at(power, u.rational()));
    const Integer far = third + (Integer(1) << static_cast<unsigned>(test::pick(random, 0, 900)) % bits);
    if (const int sign = sign_closely(*p.wide(), Dyadic(third, bits), Dyadic(far, bits))) {
      ++signs_closely;
      EXPECT_EQ(sign, p.sign_at(Dyadic(third, bits)));
      EXPECT_EQ(judge_of(scaled).roots_on(Dyadic(third, bits).rational(), Dyadic(far, bits).rational()), 0);
    }
    const Variations v = exact_variations(*p.wide(), Dyadic(1, bits), Dyadic(third + 1, bits));
    const int exact = p.restricted(Dyadic(1, bits), Dyadic(third + 1, bits)).sign_variations();
    EXPECT_TRUE(v.least <= exact && exact <= v.most);
    EXPECT_TRUE(v.least == v.most || v.least >= 2);
  }
  EXPECT_GT(signs_closely, test::rounds(30));
}

// A function and its negation share everything known about their roots, but not their signs.
TEST(WildPolynomials, TheNegativeHasTheSameRootsAndTheOtherSigns) {
  Random random(1205);
  int roots_seen = 0;
  for (int i = 0; i < test::rounds(60) && !testing::Test::HasFailure(); ++i) {
    Scaled scaled = some(random);
    if (i % 4 == 0) scaled = test::product(scaled, test::linear(1, 1));  // zero at the end of the step
    SCOPED_TRACE("seed 1205, case " + std::to_string(i) + ": " + test::describe(scaled));
    const auto own = std::make_shared<const WidePolynomial>(scaled);
    const ExactPolynomial p(own), negative(std::make_shared<const WidePolynomial>(own)), plain(scaled);
    Scaled other_signs = scaled;
    for (Integer& x : other_signs) x = -x;
    EXPECT_EQ(negative.scaled(), other_signs);
    if (p.is_zero()) continue;
    for (const Dyadic& u : {Dyadic(0.0), Dyadic(0.3), Dyadic(1.0)}) {
      EXPECT_EQ(negative.sign_at(u), -plain.sign_at(u));
      EXPECT_EQ(negative.sign_after(u), -plain.sign_after(u));
    }
    EXPECT_EQ(negative.square_free().wide(), p.square_free().wide());
    for (RootInterval& root : isolate_roots(negative.square_free(), Dyadic(0.0), Dyadic(1.0))) {
      ++roots_seen;
      ExactTime time(negative.square_free(), root);
      const int after = sign_after(p, time);
      EXPECT_EQ(sign_after(negative, time), -after);
      EXPECT_EQ(sign_at(negative, time), 0);
      ExactTime judged(plain.square_free(), root);  // an ordinary polynomial, which uses other algorithms
      EXPECT_EQ(after, sign_after(plain, judged));
      EXPECT_EQ(ExactTime::compare(time, judged), 0);
    }
  }
  EXPECT_GT(roots_seen, test::rounds(50));
}

// The gcd of two polynomials is computed once, whichever of the two is named first and however often it is
// requested.
TEST(WildPolynomials, WhatTwoHaveInCommonIsKept) {
  const Integer scale = Integer(1) << 200U;
  const Scaled shared = test::linear(scale + 3, 3 * scale);
  const auto times = [&](Integer p) { return test::product(shared, test::linear(std::move(p), 3 * scale)); };
  const ExactPolynomial a = wide(times(2 * scale + 5)), b = wide(times(scale + 9)), c = wide(times(7));
  const ExactPolynomial ab = ExactPolynomial::gcd(a, b);
  EXPECT_EQ(ab.scaled().size(), 2U);
  EXPECT_EQ(ExactPolynomial::gcd(b, a).wide(), ab.wide());
  const ExactPolynomial ac = ExactPolynomial::gcd(c, a);
  EXPECT_NE(ac.wide(), ab.wide());
  EXPECT_EQ(abs(ac.scaled()[0]), abs(ab.scaled()[0]));
  EXPECT_EQ(ExactPolynomial::gcd(a, b).wide(), ab.wide());
  // A new polynomial at the address of a destroyed one is a different polynomial.
  const ExactPolynomial other =
      wide(test::product(test::linear(2 * scale + 5, 3 * scale), test::linear(1, 5)));
  EXPECT_EQ(sturm::sign_at(sturm::from_scaled(ExactPolynomial::gcd(a, other).scaled()),
                           fraction(2 * scale + 5, 3 * scale)),
            0);
}

// A root that was recorded before the roots were isolated is stored twice. Both records must be narrowed;
// otherwise a loop that narrows the root until it is separate from another time would never end.
TEST(WildPolynomials, RootsKnownTwiceAreNarrowedTwice) {
  const Integer scale = Integer(1) << 200U;
  const auto p = std::make_shared<const WidePolynomial>(test::linear(scale + 3, 3 * scale));
  const Dyadic lower(0.25), upper(0.5);
  keep_root(*p, {lower, upper, 1, p->sign_at(lower)});
  ASSERT_EQ(isolate_roots(ExactPolynomial(p), Dyadic(0.0), Dyadic(1.0)).size(), 1U);
  for (int round = 0; round < 8; ++round) {
    const auto around = known_roots_around(*p, lower, upper);
    ASSERT_TRUE(around && around->count == 1);
    RootInterval root = around->first;
    narrow_root(*p, root);
    const auto again = known_roots_around(*p, root.lower, root.upper);
    ASSERT_TRUE(again && again->count == 1);
    EXPECT_TRUE(again->first.lower == root.lower && again->first.upper == root.upper);
  }
}

// A root that is found again has the narrow interval of the last use.
TEST(WildPolynomials, RootsStayNarrow) {
  const Integer scale = Integer(1) << 200U;
  const ExactPolynomial p =
      wide(test::product(test::linear(scale + 3, 3 * scale), test::linear(2 * scale + 5, 3 * scale)));
  const auto roots = [&] { return isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0)); };
  ASSERT_EQ(roots().size(), 2U);
  EXPECT_FALSE(has_digits(roots()[0], 64));
  ExactTime first(p.square_free(), roots()[0]);
  while (!has_digits({first.lower(), first.upper()}, 64)) first.refine();
  EXPECT_TRUE(has_digits(roots()[0], 64));
  EXPECT_FALSE(has_digits(roots()[1], 64));
  ExactTime again(p.square_free(), roots()[0]), second(p.square_free(), roots()[1]);
  EXPECT_EQ(ExactTime::compare(first, again), 0);
  EXPECT_EQ(ExactTime::compare(first, second), -1);
}

// Wide and ordinary polynomials give the same answers.
TEST(WildPolynomials, WideOrNotIsTheSame) {
  Random random(1204);
  for (int i = 0; i < test::rounds(60) && !testing::Test::HasFailure(); ++i) {
    const Scaled scaled =
        random() % 3 == 0
            ? cluster(random, test::pick(random, 2, 3), static_cast<unsigned>(test::pick(random, 1, 60)))
            : wild(random, test::pick(random, 1, 7), test::pick(random, 0, 200));
    SCOPED_TRACE("seed 1204, case " + std::to_string(i) + ": " + test::describe(scaled));
    const ExactPolynomial plain(scaled), p = wide(scaled);
    EXPECT_EQ(p.is_zero(), plain.is_zero());
    if (p.is_zero()) continue;
    EXPECT_EQ(p.sign_variations(), plain.sign_variations());
    const ExactTime start(Dyadic(0.0));
    for (const Dyadic& u : {Dyadic(0.0), Dyadic(0.25), Dyadic(1.0)})
      EXPECT_EQ(p.sign_after(u), plain.sign_after(u));
    const auto plain_roots = isolate_roots(plain.square_free(), Dyadic(0.0), Dyadic(1.0));
    const auto roots = isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0));
    ASSERT_EQ(roots.size(), plain_roots.size());
    for (std::size_t r = 0; r < roots.size(); ++r) {
      ExactTime a(p.square_free(), roots[r]), b(plain.square_free(), plain_roots[r]);
      EXPECT_EQ(ExactTime::compare(a, b), 0);
      const ExactPolynomial other = wide(wild(random, 4, 100));
      EXPECT_EQ(sign_at(other, a), sign_at(ExactPolynomial(other.scaled()), b));
      EXPECT_EQ(sign_after(p, a), sign_after(plain, b));
    }
    if (plain.sign_after(Dyadic(0.0)) <= 0) continue;
    const auto failure = first_failure_after(p, start), expected = first_failure_after(plain, start);
    ASSERT_EQ(failure.has_value(), expected.has_value());
    if (failure) {
      ExactTime a = failure->time, b = expected->time;
      EXPECT_EQ(ExactTime::compare(a, b), 0);
    }
  }
}

// Roots are isolated on demand, in any order, and equal the roots of the ordinary polynomial.
TEST(WildPolynomials, RootsAskedForInAnyOrderAreAllThereAre) {
  Random random(1206);
  for (int i = 0; i < test::rounds(60) && !testing::Test::HasFailure(); ++i) {
    const Scaled scaled =
        random() % 2 == 0
            ? cluster(random, test::pick(random, 2, 4), static_cast<unsigned>(test::pick(random, 1, 60)))
            : test::product(test::random_linear(random), wild(random, test::pick(random, 1, 7), 150));
    SCOPED_TRACE("seed 1206, case " + std::to_string(i) + ": " + test::describe(scaled));
    if (ExactPolynomial(scaled).is_zero()) continue;
    const ExactPolynomial plain = ExactPolynomial(scaled).square_free(), p = wide(scaled).square_free();
    for (int round = 0; round < 8; ++round) {
      const int low = test::pick(random, 0, 15), high = test::pick(random, low + 1, 16);
      const Dyadic lower(low / 16.0), upper(high / 16.0);
      const auto most = static_cast<std::size_t>(test::pick(random, 1, 3));
      std::vector<RootInterval> found;
      visit_roots(p, lower, upper, [&](RootInterval root) {
        found.push_back(std::move(root));
        return found.size() < most;
      });
      const auto expected = isolate_roots(plain, lower, upper);
      ASSERT_EQ(found.size(), std::min(most, expected.size()));
      for (std::size_t r = 0; r < found.size(); ++r) {
        ExactTime a(p, found[r]), b(plain, expected[r]);
        EXPECT_EQ(ExactTime::compare(a, b), 0);
      }
    }
  }
}

// Tests the sign after a root that several functions have in common, for the first and for repeated requests.
TEST(WildPolynomials, SignsAfterCommonRootsAreThoseOfOrdinaryPolynomials) {
  Random random(1207);
  int asked = 0;
  for (int i = 0; i < test::rounds(60) && !testing::Test::HasFailure(); ++i) {
    const Scaled common = random() % 2 == 0 ? test::random_linear(random) : wild(random, 2, 100);
    const Scaled a = test::product(common, wild(random, 2, 200));
    Scaled b = test::product(common, wild(random, 3, 200));
    if (random() % 2 == 0) b = test::product(b, common);
    SCOPED_TRACE("seed 1207, case " + std::to_string(i) + ": " + test::describe(a) + ", " +
                 test::describe(b));
    const ExactPolynomial plain_a(a), plain_b(b), wide_a = wide(a), wide_b = wide(b);
    if (plain_a.is_zero() || plain_b.is_zero()) continue;
    for (const RootInterval& root : isolate_roots(plain_a.square_free(), Dyadic(0.0), Dyadic(1.0))) {
      if (root.lower == Dyadic(1.0)) continue;
      ExactTime time(plain_a.square_free(), root), same(wide_a.square_free(), root);
      const int after = sign_after(plain_b, time), at = sign_at(plain_b, time);
      for (int round = 0; round < 3; ++round) {
        EXPECT_EQ(sign_after(wide_b, same), after);
        EXPECT_EQ(sign_at(wide_b, same), at);
        asked += at == 0 ? 1 : 0;
        if (round == 1) static_cast<void>(isolate_roots(wide_b.square_free(), Dyadic(0.0), Dyadic(1.0)));
        same = ExactTime(wide_a.square_free(), root);
      }
    }
  }
  EXPECT_GT(asked, test::rounds(60));
}

// A comparison starts with the interval that earlier comparisons narrowed, also if doubles isolated the root.
TEST(WildPolynomials, RootsInBracketsOfDoublesStayNarrow) {
  const Integer scale = Integer(1) << 200U;
  const ExactPolynomial p = wide(test::product(test::linear(scale + 3, 3 * scale), test::linear(9, 7)));
  const FailureTime bracket{0.25, 0.5, 0, true};
  ExactTime first = exact_time(p, bracket);
  while (!has_digits({first.lower(), first.upper()}, 64)) first.refine();
  ExactTime again = exact_time(p, bracket);
  EXPECT_TRUE(has_digits({again.lower(), again.upper()}, 64));
  EXPECT_EQ(ExactTime::compare(first, again), 0);
}

// Bisection alone would take one step per binary digit.
TEST(WildPolynomials, OrdinaryRootsOfAnotherScaleTakeFewSteps) {
  const Integer far = Integer(1) << 3000U;
  ExactTime time(ExactPolynomial(test::linear(3, 7 * far)), {Dyadic(0.0), Dyadic(1.0)});
  int steps = 0;
  for (; !has_digits({time.lower(), time.upper()}, 64) && steps < 1000; ++steps) time.refine();
  EXPECT_LT(steps, 500);
  EXPECT_LT(time.lower().rational(), fraction(3, 7 * far));
  EXPECT_LT(fraction(3, 7 * far), time.upper().rational());
  ExactTime other(ExactPolynomial(test::linear(3, 7 * far + 1)), {Dyadic(0.0), Dyadic(1.0)});
  EXPECT_EQ(ExactTime::compare(time, other), 1);
}

// Provides the coefficients of a polynomial, and counts the requests for all digits.
class Source final : public CoefficientSource {
 public:
  explicit Source(Scaled p, int& asked) : p_(std::move(p)), asked_(asked) {}
  [[nodiscard]] std::vector<BallNumber> balls(std::size_t bits) const override {
    std::vector<BallNumber> balls;
    for (const Integer& x : p_) balls.emplace_back(x, bits);
    return balls;
  }
  [[nodiscard]] std::vector<Residue> residues(std::uint64_t fold) const override {
    std::vector<Residue> image;
    for (const Integer& x : p_) image.push_back({mpz_fdiv_ui(x.get_mpz_t(), Residue::modulus(fold)), fold});
    return image;
  }
  [[nodiscard]] std::vector<Integer> whole() const override {
    ++asked_;
    return p_;
  }

 private:
  Scaled p_;
  int& asked_;
};

TEST(WildPolynomials, AllDigitsAreAskedForOnlyWhereTheyCount) {
  int asked = 0;
  const Integer big = Integer(1) << 3000;
  const ExactPolynomial p(
      std::make_shared<const WidePolynomial>(std::make_unique<Source>(Scaled{-big, 7, big + 1}, asked)));
  const auto roots = isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0));
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(p.sign_at(Dyadic(0.5)), 1);  // the terms of size 2^3000 cancel
  EXPECT_EQ(asked, 1);
}

// The ordinary polynomial gains one bit per round and the wide one thousands; the wide one must not run ahead
// without limit.
TEST(WildPolynomials, TimesOfWideAndOrdinaryFunctionsAreToldApartByFewDigits) {
  const Integer scale = Integer(1) << 200U;
  const Scaled outside = test::linear(9, 7);
  const auto time_of = [](const ExactPolynomial& p) {
    const auto roots = isolate_roots(p.square_free(), Dyadic(0.0), Dyadic(1.0));
    EXPECT_EQ(roots.size(), 1U);
    return ExactTime(p.square_free(), roots.at(0));
  };
  ExactTime plain = time_of(ExactPolynomial(test::product(test::linear(1, 3), outside)));
  ExactTime later = time_of(wide(test::product(test::linear(scale + 3, 3 * scale), outside)));
  EXPECT_EQ(ExactTime::compare(plain, later), -1);
  EXPECT_LT(later.upper().exponent(), 12000U);
  ExactTime again = time_of(ExactPolynomial(test::product(test::linear(1, 3), outside)));
  const Dyadic between = dyadic_between(again, later);
  EXPECT_LT(Rational(1) / 3, between.rational());
  EXPECT_LT(between.rational(), fraction(scale + 3, 3 * scale));
}

// A source that cannot compute its coefficients at first.
class Failing final : public CoefficientSource {
 public:
  explicit Failing(const bool& fails) : fails_(fails) {}
  [[nodiscard]] std::vector<BallNumber> balls(std::size_t bits) const override {
    const BallNumber unknown = BallNumber::around(Integer(1), 2, bits);
    return {unknown, unknown};
  }
  [[nodiscard]] std::vector<Residue> residues(std::uint64_t fold) const override {
    return {{2, fold}, {3, fold}};
  }
  [[nodiscard]] std::vector<Integer> whole() const override {
    if (fails_) throw std::runtime_error("no more work");
    return {2, 3};
  }

 private:
  const bool& fails_;
};

TEST(WildPolynomials, AnExceptionLeavesNothingHalfKnown) {
  bool fails = true;
  const ExactPolynomial p(std::make_shared<const WidePolynomial>(std::make_unique<Failing>(fails)));
  EXPECT_THROW(static_cast<void>(p.is_zero()), std::runtime_error);
  EXPECT_THROW(static_cast<void>(p.is_zero()), std::runtime_error);
  fails = false;
  EXPECT_FALSE(p.is_zero());
  EXPECT_EQ(p.sign_at(Dyadic(0.5)), 1);
}

TEST(RecentFunctions, KnowsAFunctionByAllItsNumbers) {
  RecentFunctions recent;
  const char a = 0, b = 0;
  int asked = 0;
  const auto of = [&](const char& formula, const std::vector<double>& numbers, Integer first) {
    return recent.of(&formula, numbers, std::make_unique<Source>(Scaled{std::move(first), 1}, asked))
        ->whole()[0];
  };
  EXPECT_EQ(of(a, {1, 2}, 10), 10);
  EXPECT_EQ(of(a, {1, 2}, 20), 10);
  EXPECT_EQ(of(a, {1, 3}, 30), 30);
  EXPECT_EQ(of(b, {1, 2}, 40), 40);
  EXPECT_EQ(of(a, {1}, 50), 50);
  EXPECT_EQ(asked, 4);
  const auto negative = recent.of(&a, {1, 2}, std::make_unique<Source>(Scaled{Integer(60), 1}, asked), true);
  EXPECT_EQ(negative->whole(), (Scaled{-10, -1}));
  EXPECT_EQ(negative->residues()[1].value, (-Residue{1, residue_folds[0]}).value);
  EXPECT_EQ(asked, 4);
}

}  // namespace
}  // namespace kds::wild_polynomials_test
