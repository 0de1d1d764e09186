#include "kds/failure_order.h"

#include <gmock/gmock.h>

#include <numeric>
#include <random>

#include "kds/event_queue.h"
#include "tests/support/inputs/polynomial_source.h"

namespace kds::failure_order_test {
namespace {

using namespace test;

class FailureOrderTest : public testing::Test {
 protected:
  ScheduledFailure at(double lower, double upper, std::uint32_t slot) {
    return {{lower, upper, 0, lower < upper}, 0, slot, &source};
  }
  ScheduledFailure exactly(std::uint32_t slot) { return {source.first_time(slot), 0, slot, &source}; }

  /// Checks that a comes before b and that b does not come before a, whichever question is asked first.
  void expect_before(ScheduledFailure a, ScheduledFailure b) {
    EXPECT_TRUE(order.before(a, b));
    EXPECT_FALSE(order.before(b, a));
    EXPECT_TRUE(order.before(a, b));
  }
  /// Checks that the times are equal.
  void expect_tie(ScheduledFailure a, ScheduledFailure b) {
    EXPECT_EQ(order.compare_times(a, b), 0);
    EXPECT_EQ(order.compare_times(b, a), 0);
    EXPECT_NE(order.before(a, b), order.before(b, a));
  }

  PolynomialSource source;
  FailureOrder order;
};

TEST_F(FailureOrderTest, TellsApartWhatNoDoubleCan) {
  // 1/3 and 1/3 + 3^-1 2^-200.
  const Integer huge = Integer(1) << 200;
  const auto a = source.add({huge + 1, Integer(huge + 1 - 3 * huge)}, named(1));
  const auto b = source.add(falling(1, 3), named(9));
  const double below = std::nextafter(1.0 / 3, 0);
  const double above = std::nextafter(1.0 / 3, 1);
  expect_before(at(below, above, b), at(below, above, a));
}

TEST_F(FailureOrderTest, NarrowingKeepsTheTimeInTheBracket) {
  const auto a = source.add(falling(2, 5), named(1));
  const auto b = source.add(falling(3, 7), named(2));
  ScheduledFailure fa = at(0.1, 0.9, a);
  ScheduledFailure fb = at(0.2, 0.8, b);
  EXPECT_TRUE(order.before(fa, fb));
  EXPECT_LE(fa.time.upper, fb.time.lower);
  EXPECT_LT(Rational(fa.time.lower), fraction(2, 5));
  EXPECT_GT(Rational(fa.time.upper), fraction(2, 5));
  EXPECT_LT(Rational(fb.time.lower), fraction(3, 7));
  EXPECT_GT(Rational(fb.time.upper), fraction(3, 7));
}

TEST_F(FailureOrderTest, ABracketOfSeveralRootsIsNotNarrowed) {
  // The roots are 1/5, 2/5 and 4/5. The failure at 4/5 is root number 2 of the whole step.
  const auto a = source.add(product(product(falling(1, 5), falling(2, 5)), falling(4, 5)), named(1));
  const auto b = source.add(falling(5, 7), named(2));
  ScheduledFailure last{{0, 1, 2, false}, 0, a, &source};
  ScheduledFailure first{{0, 1, 0, false}, 0, a, &source};
  ScheduledFailure other = at(0.5, 0.9, b);
  for (int round = 0; round < 2; ++round) {
    EXPECT_TRUE(order.before(other, last));
    EXPECT_FALSE(order.before(last, other));
    EXPECT_TRUE(order.before(first, other));
    EXPECT_FALSE(order.before(other, first));
  }
  for (const ScheduledFailure& failure : {first, last}) {
    // The root's number belongs to this bracket, which must not be narrowed.
    EXPECT_EQ(failure.time.lower, 0);
    EXPECT_EQ(failure.time.upper, 1);
  }
}

TEST_F(FailureOrderTest, TiesAreBrokenByTypeThenBeadsThenPlace) {
  const auto one = source.add(falling(1, 3), named(5, 1), 0);
  const auto two = source.add(falling(2, 6), named(1, 2), 0);
  const auto three = source.add(product(falling(1, 3), falling(5, 4)), named(2, 2), 7);
  const auto four = source.add(product(falling(1, 3), falling(5, 4)), named(2, 2), 8);
  const std::vector<std::uint32_t> slots{one, two, three, four};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = i + 1; j < slots.size(); ++j) {
      expect_tie(at(0.25, 0.5, slots[i]), at(0.3, 0.6, slots[j]));
      expect_before(at(0.25, 0.5, slots[i]), at(0.3, 0.6, slots[j]));
    }
  }
}

TEST_F(FailureOrderTest, EqualIrrationalRootsOfDifferentFunctionsAreATie) {
  const auto a = source.add(falling_at_root_of_one_over(2), named(3));
  const auto b = source.add(product(falling_at_root_of_one_over(2), falling(7, 6)), named(2));
  const auto c =
      source.add(product(falling_at_root_of_one_over(2), falling_at_root_of_one_over(-5)), named(1));
  expect_tie(exactly(a), exactly(b));
  expect_tie(exactly(b), exactly(c));
  expect_tie(at(0.5, 0.75, a), at(0.625, 0.875, c));
  expect_before(exactly(b), exactly(a));
  expect_before(exactly(c), exactly(b));
  EXPECT_GE(order.counts().ties, 3U);
}

// A tie at one time must not affect ties at other times.
TEST_F(FailureOrderTest, TieNumbersOfDifferentTimesDiffer) {
  // These brackets are not narrowed, so they overlap in every comparison.
  const auto wide = [&](const Scaled& function, BeadId bead) {
    return ScheduledFailure{{0.5, 0.9, 0, false}, 0, source.add(function, named(bead)), &source};
  };
  ScheduledFailure a = wide(falling_at_root_of_one_over(2), 1);
  ScheduledFailure b = wide(product(falling_at_root_of_one_over(2), falling(8, 7)), 2);
  ScheduledFailure c = wide(falling_at_root_of_one_over(3), 3);
  ScheduledFailure d = wide(product(falling_at_root_of_one_over(3), falling(8, 7)), 4);
  EXPECT_EQ(order.compare_times(a, b), 0);
  EXPECT_EQ(order.compare_times(c, d), 0);
  EXPECT_EQ(order.compare_times(c, a), -1);
  EXPECT_EQ(order.compare_times(a, c), 1);
  EXPECT_EQ(order.compare_times(b, d), 1);
  EXPECT_EQ(order.compare_times(b, a), 0);
}

TEST_F(FailureOrderTest, PointTimes) {
  const auto half = source.add(falling(1, 2), named(1));
  const auto also_half = source.add(product(falling(1, 2), falling(9, 8)), named(2));
  const auto quarter = source.add(falling(1, 4), named(3));
  const auto third = source.add(falling(1, 3), named(4));
  const auto near_half = source.add(falling(1001, 2001), named(5));
  const ScheduledFailure p = at(0.5, 0.5, half);
  expect_tie(p, at(0.5, 0.5, also_half));
  expect_before(p, at(0.5, 0.5, also_half));
  expect_before(at(0.25, 0.25, quarter), p);
  expect_before(at(0.3, 0.4, third), p);
  expect_before(at(0.3, 0.5, third), p);       // p is the upper end of the bracket
  expect_before(p, at(0.5, 0.75, near_half));  // p is the lower end of the bracket, but not the root
  expect_before(at(0.3, 0.6, third), p);       // p is inside the bracket
  expect_before(p, at(0.3, 0.6, near_half));
  expect_tie(p, at(0.3, 0.6, also_half));  // p is the root itself
  expect_before(p, at(0.3, 0.6, also_half));
}

TEST_F(FailureOrderTest, ADoubleRootElsewhereDoesNotDisturb) {
  // (1 - 3u)^2 touches zero at 1/3; the function becomes negative at 1/2.
  const auto a = source.add(product(product(falling(1, 3), falling(1, 3)), falling(1, 2)), named(1));
  const auto b = source.add(falling(3, 7), named(2));
  ScheduledFailure fa = exactly(a);
  EXPECT_LE(fa.time.lower, 0.5);
  EXPECT_GE(fa.time.upper, 0.5);
  expect_before(exactly(b), fa);
}

// Random failures that combine all cases: roots from a small set, so that many are equal; brackets of all
// widths; some shared functions. The reference sorts by rational root, identity and place.
class RandomFailures : public testing::TestWithParam<unsigned> {
 protected:
  struct Wanted {
    Rational root;
    ScheduledFailure failure;
  };

  void SetUp() override {
    std::mt19937 random(GetParam());
    const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    for (BeadId i = 0; i < 40; ++i) {
      const int q = 2 + below(6);
      const int p = 1 + below(q - 1);
      const Rational root(p, q);
      // The other factors are positive on [0, root].
      Scaled function = falling(p, q);
      std::vector<Rational> others;
      for (int extra = below(3); extra > 0; --extra) {
        const int r = q * (1 + below(3));
        const int numerator = r * p / q + 1 + below(3);
        function = product(function, falling(numerator, r));
        others.emplace_back(numerator, r);
      }
      const Identity identity = named(static_cast<BeadId>(below(1000)), static_cast<std::uint32_t>(below(3)));
      const auto slot = source.add(function, identity, i);
      FailureTime time = source.first_time(slot);
      if (below(3) != 0) {  // a wider bracket that contains no other root
        const double lower = time.lower - std::ldexp(time.lower, -1 - below(20));
        const double upper = time.upper + std::ldexp(1.0, -1 - below(20));
        const bool alone = std::none_of(others.begin(), others.end(), [&](const Rational& other) {
          return other >= Rational(lower) && other <= Rational(upper);
        });
        if (alone && upper < 1) time = {lower, upper, 0, true};
      }
      failures.push_back({root, {time, 0, slot, &source}});
      if (below(4) == 0)  // a second holder of the same certificate
        failures.push_back({root, {time, 0, source.add(function, identity, 100 + i), &source}});
    }
  }

  [[nodiscard]] bool before(const Wanted& a, const Wanted& b) const {
    const auto key = [this](const Wanted& w) {
      return std::tuple(w.root, source.identity(w.failure.slot), source.place(w.failure.slot));
    };
    return key(a) < key(b);
  }

  std::vector<std::uint32_t> expected() {
    std::sort(failures.begin(), failures.end(),
              [this](const Wanted& a, const Wanted& b) { return before(a, b); });
    std::vector<std::uint32_t> slots;
    for (const Wanted& w : failures) slots.push_back(w.failure.slot);
    return slots;
  }

  PolynomialSource source;
  std::vector<Wanted> failures;
};

TEST_P(RandomFailures, EveryPairComparesAsItsRootsDo) {
  FailureOrder order;
  for (Wanted& a : failures) {
    for (Wanted& b : failures) {
      if (&a == &b) continue;
      ScheduledFailure fresh_a = a.failure, fresh_b = b.failure;
      ASSERT_EQ(order.before(fresh_a, fresh_b), before(a, b)) << a.root << " " << b.root;
      const int sign = a.root < b.root ? -1 : a.root > b.root ? 1 : 0;
      ASSERT_EQ(order.compare_times(fresh_a, fresh_b), sign);
    }
  }
  // Repeats the comparisons with the brackets that were narrowed and the ties that were found above.
  for (int round = 0; round < 2; ++round) {
    for (Wanted& a : failures) {
      for (Wanted& b : failures) {
        if (&a == &b) continue;
        ASSERT_EQ(order.before(a.failure, b.failure), before(a, b)) << a.root << " " << b.root;
      }
    }
  }
}

TEST_P(RandomFailures, TheQueueDoesNotCareForTheOrderOfInsertion) {
  const std::vector<std::uint32_t> slots = expected();
  std::mt19937 random(GetParam() + 1000);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(failures.begin(), failures.end(), random);
    FailureOrder order;
    EventQueue<ScheduledFailure, FailureOrder> queue(order);
    for (const Wanted& w : failures) (void)queue.push([&](QueueHandle) { return w.failure; });
    std::vector<std::uint32_t> popped;
    for (; !queue.empty(); queue.pop()) popped.push_back(queue.top().slot);
    ASSERT_EQ(popped, slots);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFailures, testing::Range(1U, 13U));

}  // namespace
}  // namespace kds::failure_order_test
