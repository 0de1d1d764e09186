#include "motions/base/back_off.h"

#include <gtest/gtest.h>

#include <vector>

namespace kds::back_off_test {
namespace {

unsigned skipped(BackOff& back_off) {
  unsigned count = 0;
  while (back_off.skips()) ++count;
  return count;
}

std::vector<unsigned> skipped_after_failures(BackOff& back_off, int failures) {
  std::vector<unsigned> counts;
  for (int i = 0; i < failures; ++i) {
    back_off.lengthen();
    counts.push_back(skipped(back_off));
  }
  return counts;
}

TEST(BackOff, SkipsMoreAndMoreUpToAMost) {
  BackOff from_none(0, 15), from_some(7, 56);
  EXPECT_EQ(skipped(from_none), 0U);
  EXPECT_EQ(skipped_after_failures(from_none, 7), (std::vector<unsigned>{0, 1, 3, 7, 15, 15, 15}));
  EXPECT_EQ(skipped_after_failures(from_some, 5), (std::vector<unsigned>{7, 15, 31, 56, 56}));
}

TEST(BackOff, BeginsAnewAfterASuccess) {
  BackOff back_off(1, 7);
  EXPECT_EQ(skipped_after_failures(back_off, 3), (std::vector<unsigned>{1, 3, 7}));
  back_off.lengthen();
  back_off.reset();
  EXPECT_EQ(skipped(back_off), 0U);
  EXPECT_EQ(skipped_after_failures(back_off, 2), (std::vector<unsigned>{1, 3}));
}

}  // namespace
}  // namespace kds::back_off_test
