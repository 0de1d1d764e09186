#include "certificates/filters/bounded_polynomial.h"

#include <gtest/gtest.h>

#include <limits>

#include "motions/numbers/bernstein.h"
#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/rounds.h"

namespace kds::bounded_polynomial_test {
namespace {

namespace sturm = test::sturm;
using test::Random;

double uniform(Random& random, double low = -1, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Converts plain Bernstein coefficients to a polynomial.
sturm::Polynomial exact(const Coefficients<double>& bernstein) {
  std::vector<Integer> scaled;
  for (std::size_t k = 0; k < bernstein.size(); ++k) {
    const Dyadic c(bernstein[k]);
    scaled.push_back(binomial(static_cast<int>(bernstein.size()) - 1, static_cast<int>(k)) *
                     (c.numerator() << (1100 - c.exponent())));
  }
  sturm::Polynomial p = sturm::from_scaled(scaled);
  sturm::normalize(p);
  return p;
}

// Makes coefficients with the given error each.
BoundedPolynomial bounded(const Coefficients<double>& c, double error) {
  const int degree = static_cast<int>(c.size()) - 1;
  double largest = 0;
  for (const double x : c) largest = std::max(largest, std::abs(x));
  return {c, error + value_rounding(degree) * largest, error + local_rounding(degree) * largest};
}

std::string text_of(const Coefficients<double>& c) {
  return testing::PrintToString(std::vector<double>(c.begin(), c.end()));
}

Rational rational(double x) { return Dyadic(x).rational(); }

class BoundedPolynomials : public testing::TestWithParam<int> {
 protected:
  static int degree() { return GetParam(); }
  static Coefficients<double> fresh() {
    Coefficients<double> c;
    c.resize(static_cast<std::size_t>(degree()) + 1);
    return c;
  }

  // Every answer of the search for p must hold for all polynomials within the error; a few of them are
  // tested.
  Verdict expect_sound(const Coefficients<double>& c, double error, double from, Random& random) {
    const auto p = bounded(c, error);
    const int sign = p.certain_sign_at(from);
    const double low = from * uniform(random, 0.9, 1);
    const int sign_on = p.certain_sign_on(low, from);
    const auto result = sign > 0 ? p.first_descent(from) : BoundedPolynomial::Result{Verdict::undecided, {}};
    for (int perturbation = 0; perturbation < (error > 0 ? 6 : 1); ++perturbation) {
      Coefficients<double> near = c;
      for (std::size_t k = 0; k < near.size(); ++k) {
        const bool up = perturbation == 1 ? k % 2 == 0 : perturbation == 2 ? k % 2 == 1 : random() % 2 == 0;
        // Half of the error is kept for the rounding of the sum.
        if (perturbation > 0)
          near[k] += (up ? 1 : -1) * error * (perturbation < 4 ? 0.999 : uniform(random, 0, 0.999));
      }
      const sturm::Polynomial power = exact(near);
      EXPECT_TRUE(sign == 0 || sturm::sign_at(power, rational(from)) == sign);
      if (power.empty()) {
        EXPECT_EQ(sign, 0);
        continue;
      }
      const sturm::Sequence sequence(power);
      if (sign_on != 0) {
        EXPECT_EQ(sturm::sign_at(power, rational(from)), sign_on);
        EXPECT_EQ(sequence.roots_on(rational(low), rational(from)), 0);
      }
      if (result.verdict == Verdict::never) {
        EXPECT_EQ(sequence.roots_on(rational(from), 1), 0);
      } else if (result.verdict == Verdict::found) {
        const auto [lower, upper] = result.bracket;
        EXPECT_TRUE(from <= lower && lower < upper && upper <= 1);
        EXPECT_EQ(sequence.roots_on(rational(from), rational(lower)), 0);
        EXPECT_EQ(sequence.roots_on(rational(lower), rational(upper)), 1);
        EXPECT_LT(sturm::sign_at(power, rational(upper)), 0);
      }
    }
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << text_of(c) << " error " << error << " from " << from << " verdict "
                    << static_cast<int>(result.verdict);
    }
    return result.verdict;
  }
};

INSTANTIATE_TEST_SUITE_P(Degrees, BoundedPolynomials, testing::Values(1, 2, 3, 5, 6, 15));

TEST_P(BoundedPolynomials, WellConditionedOnesAreSettled) {
  Random random(401);
  int undecided = 0;
  int found = 0;
  int brackets_wide = 0;
  const int cases = degree() > 6 ? 150 : 500;
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed 401, case " + std::to_string(i));
    Coefficients<double> c = fresh();
    for (double& x : c) x = uniform(random);
    c[0] = uniform(random, 0.01, 1);
    const auto verdict = expect_sound(c, random() % 2 ? 0 : 1e-14, 0, random);
    undecided += verdict == Verdict::undecided;
    if (verdict == Verdict::found) {
      ++found;
      const auto bracket = bounded(c, 0).first_descent(0).bracket;
      brackets_wide += bracket.upper - bracket.lower > 1e-8;
    }
  }
  EXPECT_LE(undecided * 100, cases);
  EXPECT_GT(found * 8, cases);
  EXPECT_LE(brackets_wide * 50, found);
}

TEST_P(BoundedPolynomials, VerdictsHoldWithinTheError) {
  Random random(402);
  const int cases = test::rounds(degree() > 6 ? 200 : 1000);
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed 402, case " + std::to_string(i));
    Coefficients<double> c = fresh();
    const double scale = std::ldexp(1.0, test::pick(random, -300, 300));
    const double error = random() % 3 == 0 ? 0 : scale * std::ldexp(1.0, -test::pick(random, 1, 50));
    for (double& x : c) {
      // Sizes near the error, near its bound after subdivision, and well above.
      const double size = random() % 2 ? scale : error > 0 ? error : scale * 0x1p-46;
      x = random() % 8 == 0 ? 0 : size * uniform(random, -2, 2);
    }
    const double from = random() % 2 ? 0 : random() % 2 ? uniform(random, 0, 1) : 0.5;
    expect_sound(c, error, from, random);
  }
}

// Checks the claimed rounding error of values at doubles.
TEST_P(BoundedPolynomials, ValuesErrAsLittleAsClaimed) {
  Random random(408);
  double share = 0;
  for (int i = 0; i < test::rounds(300); ++i) {
    Coefficients<double> c = fresh();
    std::vector<Integer> scaled;
    double largest = 0;
    for (std::size_t k = 0; k < c.size(); ++k) {
      c[k] = uniform(random);
      largest = std::max(largest, std::abs(c[k]));
      const Dyadic x(c[k]);
      scaled.push_back(binomial(degree(), static_cast<int>(k)) * (x.numerator() << (200 - x.exponent())));
    }
    const double u = uniform(random, 0, 1);
    const BoundedPolynomial p{c, 0, 0};
    const Rational exact_value = sturm::value(sturm::from_scaled(scaled), rational(u)) / (Integer(1) << 200);
    const Rational error = abs(rational(p.value_at(u)) - exact_value);
    const Rational claimed = rational(value_rounding(degree()) * largest);
    EXPECT_LE(error, claimed);
    share = std::max(share, Rational(error / claimed).get_d());
  }
  EXPECT_GT(share, 0.001);
}

// Uncertain coefficients between certain ones: their signs may alternate.
TEST_P(BoundedPolynomials, DoubtfulCoefficientsProveNothing) {
  Random random(403);
  const int cases = test::rounds(degree() > 6 ? 100 : 400);
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed 403, case " + std::to_string(i));
    Coefficients<double> c = fresh();
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = (k % 2 ? -1 : 1) * uniform(random, 0.8, 1);
    c[0] = uniform(random, 1.001, 1.2);
    c[c.size() - 1] = -uniform(random, 1.001, 1.2);
    expect_sound(c, 1, 0, random);
  }
}

TEST_P(BoundedPolynomials, CloseAndMultipleRootsAreNotMisjudged) {
  Random random(404);
  int settled = 0;
  const int cases = degree() > 6 ? 150 : 400;
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed 404, case " + std::to_string(i));
    // A product of linear factors, rounded; the judge uses the rounded polynomial.
    std::vector<double> scaled{1};
    double root = uniform(random, 0, 1);
    for (int k = 0; k < degree(); ++k) {
      if (random() % 2)
        root = random() % 2 ? uniform(random, -0.5, 1.5) : root + std::ldexp(1.0, -test::pick(random, 5, 60));
      if (random() % 8 == 0) root = 0.125 * test::pick(random, 0, 8);
      std::vector<double> next(scaled.size() + 1);
      for (std::size_t j = 0; j < scaled.size(); ++j) {
        next[j] += scaled[j] * root;
        next[j + 1] += scaled[j] * (root - 1);
      }
      scaled = next;
    }
    Coefficients<double> c = fresh();
    const double flip = scaled[0] < 0 ? -1 : 1;
    for (std::size_t k = 0; k < c.size(); ++k)
      c[k] = flip * scaled[k] / static_cast<double>(binomial(degree(), static_cast<int>(k)));
    settled += expect_sound(c, random() % 2 ? 0 : 1e-16, 0, random) != Verdict::undecided;
  }
  EXPECT_GT(settled * 5, cases);
}

TEST_P(BoundedPolynomials, TheFirstOfManyDescentsIsFound) {
  if (degree() < 3) return;
  Random random(405);
  for (int i = 0; i < test::rounds(100) && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("seed 405, case " + std::to_string(i));
    Coefficients<double> c = fresh();
    for (std::size_t k = 0; k < c.size(); ++k)
      c[k] = (k % 2 ? -1 : 1) * uniform(random, 5, 9) * static_cast<double>(1U << (k % 3));
    for (const double from : {0.0, 0.1, 0.3, 0.6, 0.9, 1.0}) expect_sound(c, 0, from, random);
  }
}

TEST_P(BoundedPolynomials, NothingIsProvedOfWhatIsNoNumber) {
  Random random(406);
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < test::rounds(3000); ++i) {
    Coefficients<double> c = fresh();
    for (double& x : c) x = uniform(random);
    if (random() % 2) c[0] = 1;
    if (random() % 2) c[c.size() - 1] = -1;
    const bool bad_coefficient = random() % 4 != 0;
    const auto where = random() % c.size();
    if (bad_coefficient) c[where] = random() % 2 ? nan : random() % 2 ? inf : -inf;
    const double error = bad_coefficient ? (random() % 2 ? 1e-15 : 0) : nan;
    const BoundedPolynomial p{c, error, error};
    const double u = uniform(random, 0, 1);
    if (!bad_coefficient || std::isnan(c[where])) {
      EXPECT_EQ(p.certain_sign_at(u), 0);
      EXPECT_EQ(p.certain_sign_on(u / 2, u), 0);
      EXPECT_EQ(p.first_descent(0).verdict, Verdict::undecided) << text_of(c) << error;
      EXPECT_EQ(p.first_descent(u).verdict, Verdict::undecided) << text_of(c) << error;
    } else {
      (void)p.first_descent(0);  // computed errors, which may be infinite: no sign is certain
      const auto as_computed = bounded(c, 0);
      EXPECT_EQ(as_computed.certain_sign_at(u), 0);
      EXPECT_EQ(as_computed.first_descent(0).verdict, Verdict::undecided);
    }
  }
}

}  // namespace
}  // namespace kds::bounded_polynomial_test
