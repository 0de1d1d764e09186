#include "certificates/exact/exact_time.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/rounds.h"

namespace kds::exact_time_test {
namespace {

namespace sturm = test::sturm;
using test::Scaled;

// A time as ExactTime, and as the judge's root.
struct Time {
  ExactTime ours;
  std::shared_ptr<const sturm::Sequence> sequence;
  sturm::Root judged;
};

Time at(const Dyadic& u) {
  const Rational x = u.rational();
  return {ExactTime(u), std::make_shared<sturm::Sequence>(sturm::with_root(x)), {x, x}};
}

// Returns all roots on [from, 1).
std::vector<Time> times_of(const Scaled& scaled, const Dyadic& from) {
  const ExactPolynomial p(scaled);
  std::vector<Time> times;
  if (p.is_zero()) return times;
  const auto sequence = std::make_shared<const sturm::Sequence>(sturm::from_scaled(scaled));
  auto judged = sturm::roots_on(*sequence, from.rational(), 1);
  if (!judged.empty() && sequence->is_root(1)) judged.pop_back();
  const ExactPolynomial simple = p.square_free();
  const auto ours = isolate_roots(simple, from, Dyadic(1.0));
  EXPECT_EQ(ours.size(), judged.size());
  for (std::size_t i = 0; i < std::min(ours.size(), judged.size()); ++i) {
    times.push_back({ExactTime(simple, ours[i]), sequence, judged[i]});
  }
  return times;
}

int judge(const Time& a, const Time& b) {
  return sturm::compare(*a.sequence, a.judged, *b.sequence, b.judged);
}

// Checks that the time lies within its interval.
void expect_enclosed(const Time& time) {
  const Rational lower = time.ours.lower().rational();
  const Rational upper = time.ours.upper().rational();
  const auto sequence_at = [](const Rational& x) { return sturm::Sequence(sturm::with_root(x)); };
  const int above = sturm::compare(*time.sequence, time.judged, sequence_at(lower), {lower, lower});
  const int below = sturm::compare(*time.sequence, time.judged, sequence_at(upper), {upper, upper});
  EXPECT_EQ(above, time.ours.is_dyadic() ? 0 : 1);
  EXPECT_EQ(below, time.ours.is_dyadic() ? 0 : -1);
}

std::vector<Time> some_times(test::Random& random, std::string& trace) {
  const Scaled p = test::random_polynomial(random);
  const Scaled q = random() % 2 ? test::relative_of(p, random) : test::random_polynomial(random);
  const Dyadic from = random() % 2 ? Dyadic(0.0) : test::random_dyadic(random);
  trace += test::describe(p) + " and " + test::describe(q) + " from " + from.rational().get_str();
  std::vector<Time> times = times_of(p, from);
  for (Time& time : times_of(q, Dyadic(0.0))) times.push_back(std::move(time));
  times.push_back(at(test::random_dyadic(random)));
  return times;
}

TEST(ExactTime, ComparesAsSturmDoes) {
  test::Random random(201);
  int ties = 0;
  for (int i = 0; i < test::rounds(400) && !testing::Test::HasFailure(); ++i) {
    std::string trace = "seed 201, case " + std::to_string(i) + ": ";
    const std::vector<Time> times = some_times(random, trace);
    SCOPED_TRACE(trace);
    for (int pair = 0; pair < 8; ++pair) {
      Time a = times[random() % times.size()];
      Time b = times[random() % times.size()];
      const int expected = judge(a, b);
      EXPECT_EQ(ExactTime::compare(a.ours, b.ours), expected);
      // The comparison above has narrowed the interval.
      EXPECT_EQ(ExactTime::compare(b.ours, a.ours), -expected);
      expect_enclosed(a);
      expect_enclosed(b);
      ties += expected == 0;
    }
  }
  EXPECT_GT(ties, test::rounds(150));
}

TEST(ExactTime, NarrowsWithoutChangingTheValue) {
  test::Random random(202);
  for (int i = 0; i < test::rounds(500) && !testing::Test::HasFailure(); ++i) {
    std::string trace = "seed 202, case " + std::to_string(i) + ": ";
    std::vector<Time> times = some_times(random, trace);
    SCOPED_TRACE(trace);
    Time& time = times[random() % times.size()];
    for (int step = 0; step < 5; ++step) {
      const Rational length = time.ours.upper().rational() - time.ours.lower().rational();
      time.ours.refine();
      EXPECT_LE(time.ours.upper().rational() - time.ours.lower().rational(), length / 2);
    }
    // A narrower interval is accepted if and only if it contains the time.
    const Rational length = time.ours.upper().rational() - time.ours.lower().rational();
    const Dyadic middle = Dyadic::midpoint(time.ours.lower(), time.ours.upper());
    const Dyadic quarter = Dyadic::midpoint(time.ours.lower(), middle);
    const Dyadic last_quarter = Dyadic::midpoint(middle, time.ours.upper());
    const bool number = time.ours.is_dyadic();
    const Dyadic low = random() % 2 ? quarter : middle;
    const Dyadic high = random() % 2 ? time.ours.upper() : last_quarter;
    const bool holds = !number && judge(at(low), time) < 0 && judge(time, at(high)) < 0;
    EXPECT_EQ(time.ours.narrow_to(low, high), holds);
    EXPECT_TRUE(!holds || time.ours.upper().rational() - time.ours.lower().rational() < length);
    EXPECT_FALSE(time.ours.narrow_to(Dyadic(-1.0), time.ours.upper()));
    EXPECT_FALSE(time.ours.narrow_to(time.ours.lower(), Dyadic(2.0)));
    expect_enclosed(time);
  }
}

// For each `bits` a different number of bisections reveals the dyadic root. The range covers every budget.
TEST(ExactTime, EqualsTheDyadicThatItIs) {
  for (unsigned bits = 1; bits <= 60; ++bits) {
    const Dyadic u(Integer(1), bits);
    const ExactPolynomial p(test::linear(1, Integer(1) << bits));
    ExactTime root(p, {Dyadic(0.0), Dyadic(1.0)});
    ExactTime number(u);
    EXPECT_EQ(ExactTime::compare(root, number), 0) << bits;
    ExactTime again(p, {Dyadic(0.0), Dyadic(1.0)});
    EXPECT_EQ(ExactTime::compare(number, again), 0) << bits;
    ExactTime left(p, {Dyadic(0.0), Dyadic(1.0)});
    ExactTime right(p, {Dyadic(0.0), Dyadic(0.75)});
    EXPECT_EQ(ExactTime::compare(left, right), 0) << bits;
  }
}

TEST(ExactTime, TellsTimesThatDifferByLittle) {
  for (const unsigned bits : {10U, 15U, 16U, 17U, 60U, 300U}) {
    const Integer s = Integer(1) << bits;
    ExactTime third(ExactPolynomial(test::linear(1, 3)), {Dyadic(0.0), Dyadic(1.0)});
    ExactTime more(ExactPolynomial(test::linear(s + 1, 3 * s)), {Dyadic(0.0), Dyadic(1.0)});
    ExactTime less(ExactPolynomial(test::linear(s - 1, 3 * s)), {Dyadic(0.0), Dyadic(1.0)});
    EXPECT_EQ(ExactTime::compare(third, more), -1) << bits;
    EXPECT_EQ(ExactTime::compare(third, less), 1) << bits;
    EXPECT_EQ(ExactTime::compare(more, less), 1) << bits;
  }
}

TEST(SignAfter, IsSturms) {
  test::Random random(203);
  int zeros_there = 0;
  for (int i = 0; i < test::rounds(700) && !testing::Test::HasFailure(); ++i) {
    std::string trace = "seed 203, case " + std::to_string(i) + ": ";
    const Scaled p = test::random_polynomial(random);
    std::vector<Time> times = times_of(p, random() % 2 ? Dyadic(0.0) : test::random_dyadic(random));
    times.push_back(at(test::random_dyadic(random)));
    const Scaled f = random() % 4 == 0 ? p
                     : random() % 2    ? test::relative_of(p, random)
                                       : test::random_polynomial(random);
    SCOPED_TRACE(trace + test::describe(f) + " after a root of " + test::describe(p));
    for (int repeat = 0; repeat < 3; ++repeat) {
      Time& time = times[random() % times.size()];
      const sturm::Polynomial power = sturm::from_scaled(f);
      EXPECT_EQ(sign_after(ExactPolynomial(f), time.ours),
                sturm::sign_after(power, *time.sequence, time.judged));
      expect_enclosed(time);
      zeros_there += sturm::shares(*time.sequence, time.judged, power);
    }
  }
  EXPECT_GT(zeros_there, test::rounds(400));
}

TEST(FirstFailureAfter, IsTheFirstRootFromWhichItIsNegative) {
  test::Random random(204);
  int failures = 0;
  int touches = 0;
  for (int i = 0; i < test::rounds(1000) && !testing::Test::HasFailure(); ++i) {
    const Scaled p = test::random_polynomial(random);
    Scaled f = random() % 2 ? test::relative_of(p, random) : test::random_polynomial(random);
    std::vector<Time> times = times_of(p, random() % 2 ? Dyadic(0.0) : test::random_dyadic(random));
    times.push_back(at(test::random_dyadic(random)));
    Time now = times[random() % times.size()];
    sturm::Polynomial power = sturm::from_scaled(f);
    if (sturm::sign_after(power, *now.sequence, now.judged) < 0) {
      for (Integer& x : f) x = -x;
      for (Integer& x : power) x = -x;
    }
    SCOPED_TRACE("seed 204, case " + std::to_string(i) + ": " + test::describe(f) + " from " +
                 now.judged.lower.get_str() + ".." + now.judged.upper.get_str() + " of " + test::describe(p));
    std::optional<Time> expected;
    for (const Time& root : times_of(f, Dyadic(0.0))) {
      if (judge(root, now) <= 0) continue;
      if (sturm::sign_after(power, *root.sequence, root.judged) < 0) {
        expected = root;
        break;
      }
      touches += sturm::multiplicity(*root.sequence, root.judged, power) % 2 == 0;
    }
    EXPECT_GE(sign_after(ExactPolynomial(f), now.ours), 0);  // the call also narrows `now`
    const auto found = first_failure_after(ExactPolynomial(f), now.ours);
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found) continue;
    ++failures;
    EXPECT_FALSE(found->touch);
    ExactTime time = found->time;
    EXPECT_EQ(ExactTime::compare(time, expected->ours), 0);
    expected->ours = time;
    expect_enclosed(*expected);
  }
  EXPECT_GT(failures, test::rounds(150));
  EXPECT_GT(touches, test::rounds(30));
}

TEST(FirstFailureAfter, ReportsTouchesWhereAsked) {
  const ExactPolynomial p({1, -2, 1, 0});  // (1-u) (1-2u)^2 in scaled form, which touches zero at 1/2
  ExactTime start{Dyadic(0.0)};
  ASSERT_EQ(sign_after(p, start), 1);
  EXPECT_FALSE(first_failure_after(p, start).has_value());
  auto touch = first_failure_after(p, start, TouchPolicy::reported);
  ASSERT_TRUE(touch.has_value());
  EXPECT_TRUE(touch->touch);
  ExactTime half{Dyadic(0.5)};
  EXPECT_EQ(ExactTime::compare(touch->time, half), 0);
  EXPECT_FALSE(first_failure_after(p, touch->time, TouchPolicy::reported).has_value());
  EXPECT_EQ(sign_at(p, half), 0);
  EXPECT_EQ(sign_after(p, half), 1);
}

TEST(SignAt, IsZeroExactlyAtTheRoots) {
  const ExactPolynomial p({1, -4, 1});  // 1 - 6u + 6u^2: roots (3 -+ sqrt 3) / 6
  auto roots = isolate_roots(p, Dyadic(0.0), Dyadic(1.0));
  ASSERT_EQ(roots.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    ExactTime root(p, roots[static_cast<std::size_t>(i)]);
    EXPECT_EQ(sign_at(p, root), 0);
    EXPECT_EQ(sign_at(ExactPolynomial({2, -7, -2, 1}), root), 0);         // p times 2 - u
    EXPECT_EQ(sign_at(ExactPolynomial({1, -1}), root), i == 0 ? 1 : -1);  // 1 - 2u
    EXPECT_EQ(sign_at(ExactPolynomial(std::vector<Integer>{0, 0}), root), 0);
  }
}

TEST(FirstFailureAfter, KnownCases) {
  const auto first = [](const Scaled& p, double now) {
    ExactTime time{Dyadic(now)};
    EXPECT_GE(sign_after(ExactPolynomial(p), time), 0);
    const auto failure = first_failure_after(ExactPolynomial(p), time);
    return failure ? std::optional(failure->time) : std::nullopt;
  };
  const auto is = [](std::optional<ExactTime> time, double u) {
    ExactTime expected{Dyadic(u)};
    return time && ExactTime::compare(*time, expected) == 0;
  };
  EXPECT_TRUE(is(first({1, -1}, 0), 0.5));
  EXPECT_FALSE(first({1, 0}, 0)) << "a root at u = 1 is the next step's";
  EXPECT_TRUE(is(first({1, -1, 0}, 0), 0.5)) << "(1-2u)(1-u) fails before its root at 1";
  EXPECT_TRUE(is(first({1, -1, 0, 0}, 0), 0.5)) << "the same with a double root at 1";
  EXPECT_FALSE(first({0, 1}, 0)) << "a root at birth from which it rises";
  EXPECT_FALSE(first({1, -2, 1}, 0)) << "touching";
  EXPECT_FALSE(first({0, 0, 0}, 0));
  EXPECT_TRUE(is(first({0, 1, -1}, 0), 0.5)) << "zero at birth, fails later";
  EXPECT_FALSE(first({-1, 1}, 0.75)) << "the root is past";
  EXPECT_TRUE(is(first({1, -3, 3, -1}, 0), 0.5)) << "(1-2u)^3 fails";
  EXPECT_FALSE(first({-1, 0}, 1)) << "nothing follows u = 1";
  EXPECT_FALSE(first({1, -2, 0}, 1));
  // u (1-2u)(4u-1), which is positive on (1/4, 1/2).
  const Scaled three = test::product(test::product({0, 1}, {1, -1}), {-1, 3});
  EXPECT_TRUE(is(first(three, 0.25), 0.5));
  EXPECT_TRUE(is(first(three, 0.375), 0.5));
}

TEST(NextOnGrid, IsTheFirstMultipleAfter) {
  test::Random random(205);
  for (int i = 0; i < test::rounds(600) && !testing::Test::HasFailure(); ++i) {
    std::string trace = "seed 205, case " + std::to_string(i) + ": ";
    std::vector<Time> times = some_times(random, trace);
    Time& time = times[random() % times.size()];
    const auto bits = static_cast<unsigned>(test::pick(random, 0, 70));
    SCOPED_TRACE(trace + " bits " + std::to_string(bits));
    const Dyadic next = next_on_grid(time.ours, bits);
    EXPECT_LE(next.exponent(), bits);
    const Rational scaled = next.rational() * (Integer(1) << bits);
    const Dyadic previous(numerator(scaled) / denominator(scaled) - 1, bits);
    EXPECT_EQ(judge(time, at(next)), -1);
    EXPECT_GE(judge(time, at(previous)), 0);
  }
}

// A root at a dyadic number that bisection of its interval never hits.
TEST(NextOnGrid, EndsWhereTheTimeIsOnTheGrid) {
  const ExactPolynomial half(test::linear(1, 2));
  ExactTime time(half, {Dyadic(0.25), Dyadic(1.0)});
  EXPECT_EQ(next_on_grid(time, 1), Dyadic(1.0));
  ExactTime finer(half, {Dyadic(0.25), Dyadic(1.0)});
  EXPECT_EQ(next_on_grid(finer, 2), Dyadic(0.75));
}

TEST(DyadicBetween, LiesBetween) {
  test::Random random(206);
  for (int i = 0; i < test::rounds(600) && !testing::Test::HasFailure(); ++i) {
    std::string trace = "seed 206, case " + std::to_string(i) + ": ";
    const std::vector<Time> times = some_times(random, trace);
    SCOPED_TRACE(trace);
    Time a = times[random() % times.size()];
    Time b = times[random() % times.size()];
    const int order = judge(a, b);
    if (order == 0) continue;
    if (order > 0) std::swap(a, b);
    const Dyadic between = dyadic_between(a.ours, b.ours);
    EXPECT_EQ(judge(a, at(between)), -1);
    EXPECT_EQ(judge(at(between), b), -1);
  }
}

// A time at which many functions vanish tests each function once.
TEST(ExactTime, DoesNotGrowWithHowManyFunctionsVanishAtIt) {
  const ExactPolynomial p({Integer(2), Integer(1), Integer(-7)});
  auto roots = isolate_roots(p, Dyadic(0.0), Dyadic(1.0));
  ASSERT_EQ(roots.size(), 1U);
  ExactTime time(p, roots[0]);
  for (int i = 0; i < test::rounds(1000); ++i) {
    const ExactPolynomial same({Integer(2 * (i + 1)), Integer(i + 1), Integer(-7 * (i + 1))});
    ASSERT_EQ(sign_at(same, time), 0);
    ASSERT_EQ(sign_after(same, time), -1);
  }
  EXPECT_LT(time.upper().exponent(), 600U);
  EXPECT_GT(time.upper().exponent(), 20U);
}

}  // namespace
}  // namespace kds::exact_time_test
