// Checks of a thread: all of them answer, in their scope, on their thread.

#include "motions/base/interruption.h"

#include <gtest/gtest.h>

#include <thread>

namespace kds::interruption_test {
namespace {

struct Enough {};

TEST(InterruptionCheck, AnswersInItsScopeAndOnItsThread) {
  int outer = 0, inner = 0;
  InterruptionCheck::ask();
  {
    const InterruptionCheck of_host([&] { ++outer; });
    InterruptionCheck::ask();
    {
      const InterruptionCheck of_part([&] { ++inner; });
      InterruptionCheck::ask();
      std::thread([] { InterruptionCheck::ask(); }).join();
    }
    InterruptionCheck::ask();
  }
  InterruptionCheck::ask();
  EXPECT_EQ(outer, 3);
  EXPECT_EQ(inner, 1);
}

TEST(InterruptionCheck, EndsByAnExceptionOfAnyCheck) {
  const InterruptionCheck of_host([] { throw Enough(); });
  const InterruptionCheck of_part([] {});
  EXPECT_THROW(InterruptionCheck::ask(), Enough);
  EXPECT_THROW(InterruptionCheck::ask(), Enough);
}

}  // namespace
}  // namespace kds::interruption_test
