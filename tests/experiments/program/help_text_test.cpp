#include <gtest/gtest.h>

#include "experiments/program/command_line.h"

namespace kds::help_text_test {
namespace {

TEST(HelpText, HasTheWidthAskedFor) {
  constexpr CommandSpec command{"kds try", "Tries one two three.", "FILE", "a file", "kds try a"};
  EXPECT_EQ(
      help_text(command, {{"--input", "", "not explained here", 1, true}, {"--far", "N", "one two three"}},
                24),
      "Tries one two three.\n\nusage: kds try FILE [OPTION]...\n\n  FILE     a file\n\n"
      "kds help inputs explains\nthe options of inputs:\n--input\n\n"
      "  --far N  one two three\n  --help   print this\n           and exit\n\nexamples:\n  kds try a\n");
}

}  // namespace
}  // namespace kds::help_text_test
