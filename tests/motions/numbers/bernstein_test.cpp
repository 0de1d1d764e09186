#include "motions/numbers/bernstein.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <type_traits>

#include "motions/numbers/exact_number.h"
#include "motions/numbers/modular.h"
#include "motions/numbers/rounding_error.h"
#include "tests/support/judges/sturm.h"

namespace kds::bernstein_test {
namespace {

namespace sturm = test::sturm;

template <int Degree>
Bernstein<Integer, Degree> random_polynomial(std::mt19937_64& random) {
  Bernstein<Integer, Degree> p;
  for (Integer& x : p.scaled) x = static_cast<std::int64_t>(random() % 2001) - 1000;
  return p;
}

template <class Number, int Degree>
Rational value(const Bernstein<Number, Degree>& p, const Rational& u) {
  return sturm::value(sturm::from_scaled(p.scaled), u);
}

const Rational points[] = {0, 1, fraction(1, 2), fraction(1, 3), fraction(-7, 5), 3, fraction(22, 7)};

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

// Polynomials with degrees in the type and with degrees at run time have the same coefficients.
template <class Number, class Draw>
class SameAtRunTime {
 public:
  explicit SameAtRunTime(Draw draw) : draw_(draw) {}

  template <int Degree>
  void expect() const {
    const auto a = drawn<Degree>(), b = drawn<Degree>();
    const auto dynamic_a = at_run_time<1>(a), dynamic_b = at_run_time<1>(b);
    expect_same(dynamic_a + dynamic_b, a + b);
    expect_same(dynamic_a - dynamic_b, a - b);
    expect_same(-dynamic_a, -a);
    const auto square = dynamic_a * dynamic_a;
    static_assert(decltype(square)::degree == 2 * any_degree);
    expect_same(square, a * a);
    expect_same(square * dynamic_b - dynamic_b * dynamic_a * dynamic_b, a * a * b - b * a * b);
    expect_same(elevate<3 * any_degree>(dynamic_a), elevate<3 * Degree>(a));
    const BernsteinVector<Number, Degree, 3> u{a, b, a + b}, v{b, b - a, a};
    const BernsteinVector<Number, any_degree, 3> dynamic_u{dynamic_a, dynamic_b, dynamic_a + dynamic_b},
        dynamic_v{dynamic_b, dynamic_b - dynamic_a, dynamic_a};
    expect_same(dot(dynamic_u, dynamic_v), dot(u, v));
  }

 private:
  template <int Degree>
  [[nodiscard]] Bernstein<Number, Degree> drawn() const {
    Bernstein<Number, Degree> p;
    for (Number& c : p.scaled) c = draw_();
    return p;
  }
  template <int Times, int Degree>
  [[nodiscard]] static Bernstein<Number, Times * any_degree> at_run_time(const Bernstein<Number, Degree>& p) {
    Bernstein<Number, Times * any_degree> same;
    same.set_degree(Degree);
    std::copy(p.scaled.begin(), p.scaled.end(), same.scaled.begin());
    return same;
  }
  template <class A, class B>
  static void expect_same(const A& dynamic, const B& constant) {
    ASSERT_EQ(dynamic.scaled.size(), constant.scaled.size());
    for (std::size_t k = 0; k < constant.scaled.size(); ++k) {
      if constexpr (std::is_same_v<Number, TrackedDouble>) {
        EXPECT_EQ(dynamic.scaled[k].value, constant.scaled[k].value);
        // Elevation adds errors in another order; both results are bounds.
        const double error = constant.scaled[k].error;
        EXPECT_NEAR(dynamic.scaled[k].error, error, 0x1p-48 * error);
      } else {
        EXPECT_EQ(dynamic.scaled[k], constant.scaled[k]);
      }
    }
  }

  Draw draw_;
};

template <class Number, class Draw>
void expect_same_at_run_time(Draw draw) {
  const SameAtRunTime<Number, Draw> same(draw);
  for (int i = 0; i < 20; ++i) {
    same.template expect<1>();
    same.template expect<3>();
    same.template expect<18>();  // products need more coefficients than fit into the object itself
  }
}

TEST(Bernstein, OfDegreesKnownAtRunTimeIsTheSame) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> real(-1, 1);
  expect_same_at_run_time<double>([&] { return real(random); });
  expect_same_at_run_time<TrackedDouble>([&] {
    return TrackedDouble{real(random), std::abs(real(random)) * 0x1p-53};
  });
  expect_same_at_run_time<Residue>(
      [&] { return Residue::of(static_cast<long long>(random() >> 4U), residue_folds[3]); });
  expect_same_at_run_time<Integer>([&] { return Integer(static_cast<std::int64_t>(random())); });
}

TEST(Bernstein, OfUnlikeDegreesAtRunTimeAreNotAdded) {
  Bernstein<double, any_degree> linear, cubic;
  linear.set_degree(1);
  cubic.set_degree(3);
  EXPECT_THROW(linear += cubic, std::logic_error);
  EXPECT_THROW(linear -= cubic, std::logic_error);
  EXPECT_THROW(cubic += linear, std::logic_error);
  EXPECT_THROW(cubic -= linear, std::logic_error);
}

TEST(Binomial, IsPascalsTriangle) {
  for (int n = 0; n <= most_degree_of_function; ++n) {
    EXPECT_EQ(binomial(n, 0), 1);
    EXPECT_EQ(binomial(n, n), 1);
    for (int k = 1; k < n; ++k) EXPECT_EQ(binomial(n, k), binomial(n - 1, k - 1) + binomial(n - 1, k));
  }
}

}  // namespace
}  // namespace kds::bernstein_test
