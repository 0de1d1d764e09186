#include "certificates/exact/exact_polynomial.h"

#include <gtest/gtest.h>

#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/rounds.h"

namespace kds::exact_polynomial_test {
namespace {

namespace sturm = test::sturm;
using test::Scaled;

sturm::Polynomial power_form(const ExactPolynomial& p) { return sturm::from_scaled(p.scaled()); }

// Returns whether one polynomial is a positive multiple of the other.
bool same_up_to_positive_factor(sturm::Polynomial a, sturm::Polynomial b) {
  sturm::normalize(a);
  sturm::normalize(b);
  return a == b;
}

// Returns a positive multiple of p((upper - lower) s + lower).
sturm::Polynomial composed(const sturm::Polynomial& p, const Rational& lower, const Rational& upper) {
  const Integer d = denominator(lower) * denominator(upper);
  const Integer start = numerator(lower) * denominator(upper);
  const Integer length = numerator(upper) * denominator(lower) - start;
  sturm::Polynomial result;
  Integer power = 1;
  for (std::size_t k = p.size(); k-- > 0; power *= d) {
    sturm::Polynomial next(result.size() + 1);
    for (std::size_t i = 0; i < result.size(); ++i) {
      next[i] += result[i] * start;
      next[i + 1] += result[i] * length;
    }
    next[0] += p[k] * power;
    result = next;
  }
  sturm::trim(result);
  return result;
}

// Keeps the roots of p in [0, 1), which square-free parts and divisors keep too.
sturm::Polynomial without_root_at_one(sturm::Polynomial p) {
  while (!p.empty() && sturm::sign_at(p, 1) == 0) p = sturm::quotient(p, {-1, 1});
  return p;
}

void expect_isolated(const ExactPolynomial& p, const Dyadic& lower, const Dyadic& upper) {
  const ExactPolynomial simple = p.square_free();
  const auto found = isolate_roots(simple, lower, upper);
  if (p.is_zero()) {
    EXPECT_TRUE(found.empty());
    return;
  }
  const sturm::Sequence judge(without_root_at_one(power_form(p)));
  EXPECT_EQ(static_cast<int>(found.size()), judge.roots_on(lower.rational(), upper.rational()));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [low, high, digits, sign] = found[i];
    EXPECT_TRUE(lower <= low && high <= upper);
    if (i > 0) {
      EXPECT_TRUE(found[i - 1].upper <= low);
      const bool both_numbers = found[i - 1].lower == found[i - 1].upper && low == high;
      EXPECT_TRUE(!both_numbers || found[i - 1].upper < low);
    }
    if (low == high) {
      EXPECT_TRUE(judge.is_root(low.rational()));
    } else {
      EXPECT_TRUE(low < high);
      EXPECT_FALSE(judge.is_root(low.rational()) || judge.is_root(high.rational()));
      EXPECT_EQ(judge.roots_between(low.rational(), high.rational()), 1);
    }
  }
}

TEST(ExactPolynomial, IsolatesWhatSturmCounts) {
  test::Random random(101);
  for (int i = 0; i < test::rounds(2500) && !testing::Test::HasFailure(); ++i) {
    const ExactPolynomial p(test::random_polynomial(random));
    Dyadic lower(0.0);
    Dyadic upper(1.0);
    if (random() % 2) lower = test::random_dyadic(random);
    if (random() % 4 == 0) upper = test::random_dyadic(random);
    if (upper < lower) std::swap(lower, upper);
    SCOPED_TRACE("seed 101, case " + std::to_string(i) + ": " + test::describe(p.scaled()) + " on [" +
                 lower.rational().get_str() + ", " + upper.rational().get_str() + "]");
    expect_isolated(p, lower, upper);
  }
}

TEST(ExactPolynomial, IsolatesTheRootsOfKnownPolynomials) {
  const auto count = [](const Scaled& p) {
    return isolate_roots(ExactPolynomial(p).square_free(), Dyadic(0.0), Dyadic(1.0)).size();
  };
  EXPECT_EQ(count({}), 0U);
  EXPECT_EQ(count({0}), 0U);
  EXPECT_EQ(count({0, 0, 0}), 0U);
  EXPECT_EQ(count({7}), 0U);
  EXPECT_EQ(count({5, 5}), 0U);
  EXPECT_EQ(count({0, 1}), 1U);  // u
  EXPECT_EQ(count({1, 0}), 0U);  // 1-u: its root belongs to the next step
  EXPECT_EQ(count({0, 1, 0}), 1U);
  EXPECT_EQ(count({-1, 1}), 1U);
  EXPECT_EQ(count({1, -2, 1}), 1U);  // (1-2u)^2
  EXPECT_EQ(count(test::wilkinson(18)), 18U);
  EXPECT_EQ(
      count(test::product(test::linear(1, 3), test::linear((Integer(1) << 60) + 1, 3 * (Integer(1) << 60)))),
      2U);
}

// The binomials of this degree exceed 64 bits.
TEST(ExactPolynomial, IsolatesRootsOfHighDegrees) {
  Scaled scaled{1};
  for (int i = 1; i <= 80; ++i) scaled = test::product(scaled, test::linear(i, 97));
  const ExactPolynomial p(scaled);
  const auto roots = isolate_roots(p, Dyadic(0.0), Dyadic(1.0));
  ASSERT_EQ(roots.size(), 80U);
  for (int i = 1; i <= 80; ++i) {
    const auto& [low, high, digits, sign] = roots[static_cast<std::size_t>(i) - 1];
    EXPECT_LT(low.rational(), fraction(i, 97));
    EXPECT_GT(high.rational(), fraction(i, 97));
  }
}

TEST(ExactPolynomial, SquareFreePartHasTheSameRootsOnce) {
  test::Random random(102);
  for (int i = 0; i < test::rounds(1500) && !testing::Test::HasFailure(); ++i) {
    const ExactPolynomial p(test::random_polynomial(random));
    SCOPED_TRACE("seed 102, case " + std::to_string(i) + ": " + test::describe(p.scaled()));
    const ExactPolynomial simple = p.square_free();
    EXPECT_EQ(simple.is_zero(), p.is_zero());
    if (p.is_zero()) continue;
    // Powers of 1-u may be kept or lost; all other factors must agree up to sign.
    sturm::Polynomial expected = sturm::square_free(without_root_at_one(power_form(p)));
    sturm::Polynomial found = without_root_at_one(power_form(simple));
    sturm::normalize(expected);
    sturm::normalize(found);
    if (!found.empty() && sturm::sign(expected.back()) != sturm::sign(found.back())) {
      for (Integer& x : found) x = -x;
    }
    EXPECT_EQ(expected, found);
  }
}

TEST(ExactPolynomial, CommonDivisorIsThatOfThePowerBasis) {
  test::Random random(103);
  int common_factors = 0;
  for (int i = 0; i < test::rounds(1500) && !testing::Test::HasFailure(); ++i) {
    const Scaled p = test::random_polynomial(random);
    const Scaled q = random() % 2 ? test::relative_of(p, random) : test::random_polynomial(random);
    SCOPED_TRACE("seed 103, case " + std::to_string(i) + ": " + test::describe(p) + " and " +
                 test::describe(q));
    const ExactPolynomial a(p);
    const ExactPolynomial b(q);
    if (a.is_zero() && b.is_zero()) continue;
    const ExactPolynomial g = ExactPolynomial::gcd(a, b);
    const sturm::Polynomial expected = without_root_at_one(sturm::gcd(power_form(a), power_form(b)));
    sturm::Polynomial found = without_root_at_one(power_form(g));
    sturm::normalize(found);
    if (!found.empty() && found.back() != expected.back()) {
      for (Integer& x : found) x = -x;
    }
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(!g.is_constant() || expected.size() <= 1);
    common_factors += expected.size() > 1;
  }
  EXPECT_GT(common_factors, test::rounds(300));
}

// A polynomial written with a higher degree than its own has factors (1-u) + u = 1, which are neither
// repeated nor common roots.
TEST(ExactPolynomial, ElevationIsDividedOut) {
  test::Random random(31);
  const auto elevated = [](std::vector<Integer> c, int times) {
    for (; times > 0; --times) {
      c.emplace_back(0);
      for (std::size_t k = c.size(); k-- > 1;) c[k] += c[k - 1];
    }
    return ExactPolynomial(std::move(c));
  };
  for (int round = 0; round < test::rounds(50); ++round) {
    std::vector<Integer> c(6), other(5);
    for (Integer& x : c) x = test::pick(random, -1000, 1000);
    for (Integer& x : other) x = test::pick(random, -1000, 1000);
    c.back() = other.back() = 7;
    const ExactPolynomial low = ExactPolynomial(c).square_free();
    const ExactPolynomial high = elevated(c, test::pick(random, 2, 30)).square_free();
    EXPECT_EQ(high.scaled().size(), low.scaled().size());
    for (const double u : {0.0, 0.25, 0.5, 0.8125})
      EXPECT_EQ(high.sign_at(Dyadic(u)), low.sign_at(Dyadic(u)));
    EXPECT_EQ(isolate_roots(high, Dyadic(0.0), Dyadic(1.0)).size(),
              isolate_roots(low, Dyadic(0.0), Dyadic(1.0)).size());
    EXPECT_EQ(ExactPolynomial::gcd(elevated(c, 9), elevated(other, 4)).scaled().size(),
              ExactPolynomial::gcd(ExactPolynomial(c), ExactPolynomial(other)).scaled().size());
  }
}

TEST(ExactPolynomial, SignsAtAndAfterDyadics) {
  test::Random random(104);
  int zeros = 0;
  for (int i = 0; i < test::rounds(4000) && !testing::Test::HasFailure(); ++i) {
    const ExactPolynomial p(test::random_polynomial(random));
    const Dyadic u = random() % 8 == 0 ? Dyadic(1.0) : test::random_dyadic(random);
    SCOPED_TRACE("seed 104, case " + std::to_string(i) + ": " + test::describe(p.scaled()) + " at " +
                 u.rational().get_str());
    const sturm::Polynomial power = power_form(p);
    EXPECT_EQ(p.sign_at(u), sturm::sign_at(power, u.rational()));
    EXPECT_EQ(p.sign_after(u), sturm::sign_after(power, u.rational()));
    zeros += p.sign_at(u) == 0;
  }
  EXPECT_GT(zeros, test::rounds(400));
}

TEST(ExactPolynomial, RestrictsToAnInterval) {
  test::Random random(105);
  for (int i = 0; i < test::rounds(1500) && !testing::Test::HasFailure(); ++i) {
    const ExactPolynomial p(test::random_polynomial(random));
    SCOPED_TRACE("seed 105, case " + std::to_string(i) + ": " + test::describe(p.scaled()));
    const sturm::Polynomial power = power_form(p);
    Dyadic lower = test::random_dyadic(random);
    Dyadic upper = test::random_dyadic(random);
    if (upper < lower) std::swap(lower, upper);
    EXPECT_TRUE(same_up_to_positive_factor(power_form(p.restricted(lower, upper)),
                                           composed(power, lower.rational(), upper.rational())));
  }
}

TEST(ExactPolynomial, CountsSignVariations) {
  const auto count = [](const Scaled& p) { return ExactPolynomial(p).sign_variations(); };
  EXPECT_EQ(count({}), 0);
  EXPECT_EQ(count({0, 0}), 0);
  EXPECT_EQ(count({1, 0, 2}), 0);
  EXPECT_EQ(count({1, 0, -2}), 1);
  EXPECT_EQ(count({0, -1, 0, 0, 1, 0}), 1);
  EXPECT_EQ(count({1, -1, 1, -1}), 3);
  EXPECT_EQ(count({-5, 1, 0, 1, -1, -1}), 2);
}

TEST(ExactPolynomial, MeasuresItsCoefficients) {
  EXPECT_EQ(ExactPolynomial().largest_bit_length(), 0U);
  EXPECT_EQ(ExactPolynomial(Scaled{0, 0}).largest_bit_length(), 0U);
  EXPECT_EQ(ExactPolynomial(Scaled{1, -4, 3}).largest_bit_length(), 3U);
  EXPECT_EQ(ExactPolynomial(Scaled{1, -(Integer(1) << 200)}).largest_bit_length(), 201U);
}

}  // namespace
}  // namespace kds::exact_polynomial_test
