#include "experiments/program/option_values.h"

#include <gtest/gtest.h>

#include <array>

namespace kds::suggestion_test {
namespace {

TEST(Suggestion, NamesTheNearest) {
  constexpr std::array<std::string_view, 8> names{"--frames", "--structures", "--radius", "--audit",
                                                  "--out",    "run",          "replay",   "random-chain"};
  const auto nearest = [&](std::string_view word) { return nearest_name(word, names).value_or("none"); };
  EXPECT_EQ(nearest("--frame"), "--frames");
  EXPECT_EQ(nearest("-frames"), "--frames");
  EXPECT_EQ(nearest("frames"), "--frames");
  EXPECT_EQ(nearest("--FRAMES"), "--frames");
  EXPECT_EQ(nearest("--struct"), "--structures");
  EXPECT_EQ(nearest("--raduis"), "--radius");  // an exchange of two letters counts once
  EXPECT_EQ(nearest("--radii"), "--radius");   // two edits of six letters
  EXPECT_EQ(nearest("rnu"), "run");
  EXPECT_EQ(nearest("reply"), "replay");
  EXPECT_EQ(nearest("chain"), "random-chain");
  for (const char* word : {"", "-", "--", "fly", "--kernel", "x"}) EXPECT_EQ(nearest(word), "none") << word;
  EXPECT_EQ(nearest(std::string(100'000, 'r')), "none");
  EXPECT_EQ(suggestion("rnu", names), ", did you mean run?");
  EXPECT_EQ(suggestion("fly", names), "");
}

}  // namespace
}  // namespace kds::suggestion_test
