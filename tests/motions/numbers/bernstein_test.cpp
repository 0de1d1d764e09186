#include "motions/numbers/bernstein.h"

#include <gtest/gtest.h>

#include <random>

#include "motions/numbers/exact_number.h"
#include "tests/support/sturm.h"

namespace kds {
namespace {

namespace sturm = test::sturm;

template <int Degree>
Bernstein<Integer, Degree> random_polynomial(std::mt19937_64& random) {
  Bernstein<Integer, Degree> p;
  for (Integer& x : p.scaled) x = static_cast<long long>(random() % 2001) - 1000;
  return p;
}

template <class Number, int Degree>
Rational value(const Bernstein<Number, Degree>& p, const Rational& u) {
  return sturm::value(sturm::from_scaled(p.scaled), u);
}

const Rational points[] = {0, 1, Rational(1, 2), Rational(1, 3), Rational(-7, 5), 3, Rational(22, 7)};

template <int A, int B>
void expect_ring_laws(std::mt19937_64& random) {
  const auto a = random_polynomial<A>(random);
  const auto b = random_polynomial<B>(random);
  const auto c = random_polynomial<A>(random);
  const auto ab = a * b;
  static_assert(decltype(ab)::degree == A + B);
  for (const Rational& u : points) {
    EXPECT_EQ(value(ab, u), value(a, u) * value(b, u));
    EXPECT_EQ(value(a + c, u), value(a, u) + value(c, u));
    EXPECT_EQ(value(a - c, u), value(a, u) - value(c, u));
    EXPECT_EQ(value(-a, u), -value(a, u));
    EXPECT_EQ(value(elevate<A + B>(a), u), value(a, u));
  }
  EXPECT_EQ((a * b).scaled, (b * a).scaled);
  EXPECT_EQ(elevate<A>(a).scaled, a.scaled);
}

TEST(Bernstein, ComputesAsThePowerBasisDoes) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 30; ++i) {
    expect_ring_laws<0, 0>(random);
    expect_ring_laws<0, 3>(random);
    expect_ring_laws<1, 1>(random);
    expect_ring_laws<1, 4>(random);
    expect_ring_laws<4, 1>(random);
    expect_ring_laws<3, 3>(random);
    expect_ring_laws<6, 12>(random);
  }
}

TEST(Bernstein, DotIsTheSumOfProducts) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 30; ++i) {
    BernsteinVector<Integer, 2, 3> a;
    BernsteinVector<Integer, 3, 3> b;
    for (auto& x : a) x = random_polynomial<2>(random);
    for (auto& x : b) x = random_polynomial<3>(random);
    for (const Rational& u : points) {
      Rational expected = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) expected += value(a[axis], u) * value(b[axis], u);
      EXPECT_EQ(value(dot(a, b), u), expected);
    }
  }
}

TEST(Bernstein, EndCoefficientsAreTheValuesThere) {
  const Bernstein<Integer, 3> p{{5, -2, 7, 11}};
  EXPECT_EQ(value(p, 0), 5);
  EXPECT_EQ(value(p, 1), 11);
}

TEST(Bernstein, IsUsableInConstants) {
  constexpr Bernstein<double, 1> p{{1, -1}};  // 1-2u
  constexpr auto square = p * p;
  static_assert(square.scaled[0] == 1 && square.scaled[1] == -2 && square.scaled[2] == 1);
  static_assert(elevate<2>(p).scaled[1] == 0);
}

TEST(Binomial, IsPascalsTriangle) {
  for (int n = 0; n <= 40; ++n) {
    EXPECT_EQ(binomial(n, 0), 1);
    EXPECT_EQ(binomial(n, n), 1);
    for (int k = 1; k < n; ++k) EXPECT_EQ(binomial(n, k), binomial(n - 1, k - 1) + binomial(n - 1, k));
  }
}

}  // namespace
}  // namespace kds
