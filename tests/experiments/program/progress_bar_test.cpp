#include "experiments/program/progress_bar.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace kds::progress_bar_test {
namespace {

TEST(ProgressBar, IsSilentWhereTheStreamIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    ProgressBar bar(true, file);
    for (std::size_t step = 0; step <= 100; ++step) bar.update(step, 100);
    bar.update(0, 0);
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

}  // namespace
}  // namespace kds::progress_bar_test
