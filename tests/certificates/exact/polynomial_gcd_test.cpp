#include "certificates/exact/polynomial_gcd.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/rounds.h"

namespace kds::polynomial_gcd_test {
namespace {

namespace sturm = test::sturm;
using test::Scaled;

const Integer prime = (Integer(1) << 61) - 1;

// Coefficients of 1, x, x^2, ... (in this file only).
Scaled random_power(test::Random& random, int degree) {
  Scaled p = test::random_coefficients(random, degree, static_cast<unsigned>(test::pick(random, 1, 200)));
  if (p.back() == 0) p.back() = 1;
  return p;
}

TEST(PolynomialGcd, NeverDeniesACommonFactor) {
  test::Random random(801);
  for (int i = 0; i < test::rounds(2000); ++i) {
    const Scaled factor = random_power(random, test::pick(random, 1, 4));
    const Scaled a = test::product(factor, random_power(random, test::pick(random, 0, 8)));
    const Scaled b = test::product(factor, random_power(random, test::pick(random, 0, 8)));
    EXPECT_FALSE(certainly_coprime(a, b)) << "seed 801, case " << i << test::describe(a) << test::describe(b);
  }
}

TEST(PolynomialGcd, MostlySeesThatThereIsNone) {
  test::Random random(802);
  int coprime = 0;
  int seen = 0;
  for (int i = 0; i < test::rounds(500); ++i) {
    const Scaled a = random_power(random, test::pick(random, 1, 9));
    const Scaled b = random_power(random, test::pick(random, 1, 9));
    const bool answer = certainly_coprime(a, b);
    const bool truth =
        sturm::gcd(sturm::Polynomial(a.begin(), a.end()), sturm::Polynomial(b.begin(), b.end())).size() <= 1;
    EXPECT_TRUE(truth || !answer) << "seed 802, case " << i;
    coprime += truth;
    seen += answer;
  }
  // A random resultant is practically never divisible by a prime of 61 bits.
  EXPECT_EQ(seen, coprime);
}

TEST(PolynomialGcd, SaysNothingWhereThePrimeHidesTheDegree) {
  // x + 1 divides both polynomials, but modulo the prime one of them is constant.
  EXPECT_FALSE(certainly_coprime({1, 1}, test::product({1, 1}, {1, prime})));
  EXPECT_FALSE(certainly_coprime(test::product({1, prime}, {1, 1}), {1, 1}));
  EXPECT_FALSE(certainly_coprime({5, prime}, {5, prime}));
  EXPECT_FALSE(certainly_coprime({}, {1, 1}));
  EXPECT_TRUE(certainly_coprime({3}, {1, 1}));
  EXPECT_TRUE(certainly_coprime({1, 1}, {2, 1}));
}

TEST(PolynomialGcd, ProvesSquareFreeness) {
  test::Random random(803);
  for (int i = 0; i < test::rounds(1000); ++i) {
    const Scaled p = random_power(random, test::pick(random, 1, 8));
    const Scaled factor = random_power(random, test::pick(random, 1, 3));
    EXPECT_FALSE(certainly_square_free(test::product(p, test::product(factor, factor)))) << "case " << i;
  }
  EXPECT_TRUE(certainly_square_free({1, 1}));
  EXPECT_TRUE(certainly_square_free({-1, 0, 1}));
  EXPECT_TRUE(certainly_square_free({0, 1, 0, 1}));
  EXPECT_FALSE(certainly_square_free({1, 2, 1}));
  EXPECT_FALSE(certainly_square_free({-1, 0, prime}));
}

// Compares with Euclid's algorithm over integers.
TEST(PolynomialGcd, FindsTheGcd) {
  test::Random random(804);
  for (int i = 0; i < test::rounds(600) && !testing::Test::HasFailure(); ++i) {
    const Scaled factor = random_power(random, test::pick(random, 0, 5));
    const Scaled a =
        test::product(test::product(factor, factor), random_power(random, test::pick(random, 0, 6)));
    const Scaled b = test::product(factor, random_power(random, test::pick(random, 0, 6)));
    SCOPED_TRACE("seed 804, case " + std::to_string(i) + test::describe(a) + test::describe(b));
    sturm::Polynomial expected =
        sturm::gcd(sturm::Polynomial(a.begin(), a.end()), sturm::Polynomial(b.begin(), b.end()));
    const Scaled g = polynomial_gcd(a, b);
    sturm::Polynomial found(g.begin(), g.end());
    sturm::normalize(expected);
    sturm::normalize(found);
    if (sturm::sign(found.back()) != sturm::sign(expected.back()))
      for (Integer& x : found) x = -x;
    EXPECT_EQ(found, expected);
    EXPECT_GT(g.back(), 0);
  }
}

TEST(PolynomialGcd, FindsLongFactors) {
  test::Random random(805);
  const Scaled factor = test::random_coefficients(random, 3, 4000);
  const Scaled a = test::product(factor, {1, 1}), b = test::product(factor, {3, 0, 1});
  const Scaled g = polynomial_gcd(a, b);
  sturm::Polynomial expected(factor.begin(), factor.end()), found(g.begin(), g.end());
  sturm::normalize(expected);
  if (sturm::sign(expected.back()) < 0)
    for (Integer& x : expected) x = -x;
  EXPECT_EQ(found, expected);
}

TEST(PolynomialGcd, IsNotDeceivedByPrimesThatHideADegree) {
  const Scaled a = test::product({1, 1}, {1, prime}), b = test::product({1, 1}, {2, prime});
  const Scaled g = polynomial_gcd(a, b);
  EXPECT_EQ(g, (Scaled{1, 1}));
}

TEST(PolynomialGcd, OfZeroIsTheOther) {
  EXPECT_EQ(polynomial_gcd({}, {-2, -4}), (Scaled{1, 2}));
  EXPECT_EQ(polynomial_gcd({-2, -4}, {}), (Scaled{1, 2}));
  EXPECT_TRUE(polynomial_gcd({}, {}).empty());
}

// Compares with Euclid's algorithm over integers.
TEST(PolynomialGcd, DividesOutRepeatedFactors) {
  test::Random random(806);
  for (int i = 0; i < test::rounds(300) && !testing::Test::HasFailure(); ++i) {
    const Scaled factor = random_power(random, test::pick(random, 1, 4));
    const Scaled p =
        test::product(test::product(factor, factor), random_power(random, test::pick(random, 0, 5)));
    SCOPED_TRACE("seed 806, case " + std::to_string(i) + test::describe(p));
    const Scaled once = without_repeated_factors(p);
    sturm::Polynomial expected = sturm::square_free({p.begin(), p.end()});
    if (sturm::sign(expected.back()) != sturm::sign(p.back()))
      for (Integer& x : expected) x = -x;
    EXPECT_EQ(sturm::Polynomial(once.begin(), once.end()), expected);
  }
  EXPECT_EQ(without_repeated_factors({-4, 8, -4}), (Scaled{1, -1}));
}

// FLINT allocates memory per thread, and each thread releases its memory.
TEST(PolynomialGcd, IsFoundInAnyThread) {
  test::Random random(807);
  const Scaled factor = test::random_coefficients(random, 3, 400);
  const Scaled a = test::product(factor, {1, 1}), b = test::product(factor, {3, 0, 1});
  const Scaled expected = polynomial_gcd(a, b);
  for (int i = 0; i < 3; ++i) std::thread([&] { EXPECT_EQ(polynomial_gcd(a, b), expected); }).join();
}

}  // namespace
}  // namespace kds::polynomial_gcd_test
