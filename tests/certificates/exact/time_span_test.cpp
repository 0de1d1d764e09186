#include "certificates/exact/time_span.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/rounds.h"

namespace kds::time_span_test {
namespace {

namespace sturm = test::sturm;
using test::pick;
using test::Random;
using test::Scaled;

/// A time as ExactTime, and as the judge's root.
struct Time {
  ExactTime ours;
  sturm::Polynomial polynomial;
  sturm::Root root;
};

std::vector<Time> times_of(const Scaled& scaled) {
  std::vector<Time> times;
  const ExactPolynomial simple = ExactPolynomial(scaled).square_free();
  if (simple.is_constant()) return times;
  const sturm::Polynomial polynomial = sturm::from_scaled(scaled);
  const sturm::Sequence sequence(polynomial);
  const auto roots = sturm::roots_on(sequence, 0, 1);
  const auto ours = isolate_roots(simple, Dyadic(0.0), Dyadic(1.0));
  for (std::size_t i = 0; i < ours.size() && i < roots.size(); ++i)
    times.push_back({ExactTime(simple, ours[i]), polynomial, roots[i]});
  return times;
}

/// Returns p(offset + rate x) times a positive number.
sturm::Polynomial composed(const sturm::Polynomial& p, const Rational& offset, const Rational& rate) {
  std::vector<Rational> sum;
  for (std::size_t k = p.size(); k-- > 0;) {  // Horner's rule
    std::vector<Rational> next(sum.size() + 1);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      next[i] += offset * sum[i];
      next[i + 1] += rate * sum[i];
    }
    next[0] += p[k];
    sum = next;
  }
  Integer common = 1;
  for (const Rational& x : sum) common = lcm(common, Integer(denominator(x)));
  sturm::Polynomial whole;
  for (const Rational& x : sum) whole.push_back(Integer(numerator(Rational(x * common))));
  sturm::normalize(whole);
  return whole;
}

/// Returns sum c_j u^j in scaled Bernstein form.
Scaled scaled_of(const sturm::Polynomial& powers) {
  const std::size_t n = powers.size() - 1;
  Scaled scaled(powers.size());
  for (std::size_t j = 0; j <= n; ++j) {
    Integer binomial = 1;  // n-j over i
    for (std::size_t i = 0; i + j <= n; ++i) {
      scaled[i + j] += powers[j] * binomial;
      binomial = binomial * Integer(n - j - i) / Integer(i + 1);
    }
  }
  return scaled;
}

/// Compares two times by Sturm's theorem: both polynomials are rewritten in the time of the clock.
int judged(const Time& earlier, const StepClock& b, const Time& later, const StepClock& e, double length) {
  const Rational long_step = Rational(b.end) - Rational(b.begin), step = Rational(e.end) - Rational(e.begin);
  const Rational start(b.begin), from = Rational(e.begin) - Rational(length);
  const sturm::Polynomial p = composed(earlier.polynomial, -start / long_step, 1 / long_step);
  const sturm::Polynomial q = composed(later.polynomial, -from / step, 1 / step);
  const auto read = [](const sturm::Root& root, const Rational& at, const Rational& scale) {
    return sturm::Root{at + scale * root.lower, at + scale * root.upper};
  };
  return sturm::compare(sturm::Sequence(q), read(later.root, from, step), sturm::Sequence(p),
                        read(earlier.root, start, long_step));
}

StepClock random_clock(Random& random, double from) {
  const double begin = from + 0.25 * pick(random, 0, 8);
  return {begin, begin + (random() % 3 == 0 ? 0.1 : 0.25 * pick(random, 1, 8))};
}

TEST(TimeSpan, ComparesAsSturmDoes) {
  Random random(301);
  int shorter = 0, longer = 0, equal = 0;
  for (int round = 0; round < test::rounds(500) && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE("seed 301, case " + std::to_string(round));
    std::vector<Time> first = times_of(test::small_polynomial(random));
    if (first.empty()) continue;
    const StepClock b = random_clock(random, 0), e = random() % 4 == 0 ? b : random_clock(random, 1);
    const double length = 0.125 * pick(random, 0, 20);
    // In every second case, the later polynomial has the images of the earlier roots, in its own step.
    const Rational step = Rational(b.end) - Rational(b.begin);
    const Rational offset = (Rational(e.begin) - Rational(length) - Rational(b.begin)) / step,
                   rate = (Rational(e.end) - Rational(e.begin)) / step;
    std::vector<Time> second = random() % 2 == 0
                                   ? times_of(test::small_polynomial(random))
                                   : times_of(scaled_of(composed(first.front().polynomial, offset, rate)));
    for (const Time& x : first) {
      for (const Time& y : second) {
        ExactTime earlier = x.ours, later = y.ours;
        const int sign = compare_span(earlier, b, later, e, length);
        ASSERT_EQ(sign, judged(x, b, y, e, length))
            << b.begin << " " << b.end << " " << e.begin << " " << length;
        ++(sign < 0 ? shorter : sign > 0 ? longer : equal);
      }
    }
  }
  if (HasFailure()) return;
  EXPECT_GT(shorter, test::rounds(30));
  EXPECT_GT(longer, test::rounds(30));
  EXPECT_GT(equal, test::rounds(30));
}

TEST(TimeSpan, OfTheSameTimeIsZero) {
  for (const Time& time : times_of(test::quadratic(2, 0, -1))) {  // sqrt(1/2)
    const auto compared = [&](double length) {
      ExactTime a = time.ours, b = time.ours;
      return compare_span(a, {0, 1}, b, {0, 1}, length);
    };
    EXPECT_EQ(compared(0), 0);
    EXPECT_EQ(compared(0x1p-1000), -1);
    ExactTime a = time.ours, b = time.ours;  // one step later, at the same place
    EXPECT_EQ(compare_span(a, {4, 6}, b, {6, 8}, 2), 0);
    EXPECT_EQ(compare_span(a, {4, 6}, b, {6, 8}, std::nextafter(2, 3)), -1);
    EXPECT_EQ(compare_span(a, {4, 6}, b, {6, 8}, std::nextafter(2, 1)), 1);
  }
}

TEST(TimeSpan, ComparesWithRationals) {
  Random random(302);
  for (int round = 0; round < test::rounds(200); ++round) {
    for (const Time& time : times_of(test::small_polynomial(random))) {
      const Rational place = Rational(pick(random, -2, 12)) / pick(random, 1, 12);
      ExactTime ours = time.ours;
      ASSERT_EQ(compare_with(ours, place),
                sturm::compare(sturm::Sequence(time.polynomial), time.root,
                               sturm::Sequence(sturm::with_root(place)), {place, place}));
    }
  }
}

}  // namespace
}  // namespace kds::time_span_test
