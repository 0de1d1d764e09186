#include "experiments/program/progress_bar.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace kds::progress_bar_test {
namespace {

TEST(ProgressBar, IsSilentWhereTheStreamIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    ProgressBar bar(true, "step", file);
    for (std::size_t step = 0; step <= 100; ++step) bar.update(step, 100);
    bar.update(0, 0);
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

TEST(ProgressBar, SaysWhatItCountsAndHowLongTheRestTakes) {
  EXPECT_EQ(progress_line("step", 8, 0, 32, 30),
            "[########........................] step 8 of 32, 30 s, about 90 s left");
  EXPECT_EQ(progress_line("run", 0, 0.25, 1, 100),
            "[########........................] run 0 of 1, 100 s, about 5 min left");
  EXPECT_EQ(progress_line("run", 0, 0, 4, 9000), "[................................] run 0 of 4, 2.5 h");
  EXPECT_EQ(progress_line("run", 4, 0, 4, 10), "[################################] run 4 of 4, 10 s");
  EXPECT_EQ(progress_line("run", 1, 0, 4, 1), "[########........................] run 1 of 4, 1 s");
}

}  // namespace
}  // namespace kds::progress_bar_test
