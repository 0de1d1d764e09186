#include "certificates/exact/exact_work.h"

#include <gtest/gtest.h>

#include <thread>

#include "certificates/exact/exact_time.h"
#include "certificates/exact/recent_functions.h"

namespace kds::exact_work_test {
namespace {

struct Named {
  BeadId bead;
  [[nodiscard]] Identity identity() const {
    return identity_of(CertificateType{7, "named"}, std::array{bead});
  }
};

// (3u - 1)(3u - 2)
ExactPolynomial some_polynomial() { return ExactPolynomial({Integer(2), Integer(-5), Integer(2)}); }

std::uint64_t work_of_roots(ExactWork& account) {
  const ExactWork::Open open(account);
  const std::uint64_t before = account.done();
  EXPECT_EQ(isolate_roots(some_polynomial(), Dyadic(0.0), Dyadic(1.0)).size(), 2U);
  return account.done() - before;
}

TEST(ExactWork, CountsAlikeEachTime) {
  ExactWork one, other;
  const std::uint64_t work = work_of_roots(one);
  EXPECT_GT(work, 0U);
  EXPECT_EQ(work_of_roots(one), work);
  EXPECT_EQ(work_of_roots(other), work);
  EXPECT_EQ(one.done(), 2 * work);
}

TEST(ExactWork, GoesToTheAccountThatIsOpen) {
  ExactWork outer, inner;
  const ExactWork::Open open(outer);
  ExactWork::spend(3);
  {
    const ExactWork::Open again(inner);
    ExactWork::spend(5);
    // The work of another thread is not charged to this account.
    std::thread([] { ExactWork::spend(100); }).join();
  }
  ExactWork::spend(4);
  EXPECT_EQ(outer.done(), 7U);
  EXPECT_EQ(inner.done(), 5U);
}

TEST(ExactWork, EndsAtItsLimit) {
  ExactWork free, bound;
  const std::uint64_t work = work_of_roots(free);
  bound.set_limit(work);
  EXPECT_EQ(work_of_roots(bound), work);
  EXPECT_THROW(static_cast<void>(work_of_roots(bound)), WorkLimitReached);
  ExactWork none;
  none.set_limit(0);
  EXPECT_THROW(static_cast<void>(work_of_roots(none)), WorkLimitReached);
}

TEST(ExactWork, SaysWhatItWasAbout) {
  ExactWork account;
  account.set_limit(10);
  const ExactWork::Open open(account);
  const Named first{1}, second{2};
  const ExactWork::About about(first);
  {
    const ExactWork::About inner(second);
    EXPECT_EQ(account.subject(), second.identity());
  }
  EXPECT_EQ(account.subject(), first.identity());
  try {
    const ExactWork::About inner(second);
    ExactWork::spend(11);
    FAIL() << "no limit";
  } catch (const WorkLimitReached& limit) {
    EXPECT_EQ(limit.subject(), second.identity());
  }
  EXPECT_EQ(account.subject(), first.identity());
}

TEST(ExactWork, CallsItsWatcherAsWorkGoesOn) {
  ExactWork account;
  const ExactWork::Open open(account);
  ExactWork::spend(1000);
  int calls = 0;
  account.set_watcher([&] { ++calls; }, 100);
  for (int i = 0; i < 99; ++i) ExactWork::spend(1);
  EXPECT_EQ(calls, 0);
  ExactWork::spend(1);
  EXPECT_EQ(calls, 1);
  ExactWork::spend(1000);  // the watcher is called once, however much work is spent at once
  EXPECT_EQ(calls, 2);
  account.set_limit(account.done() + 150);
  ExactWork::spend(120);
  EXPECT_EQ(calls, 3);
  EXPECT_THROW(ExactWork::spend(31), WorkLimitReached);
}

}  // namespace
}  // namespace kds::exact_work_test
