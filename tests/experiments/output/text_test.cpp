#include "experiments/output/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace kds::text_test {
namespace {

TEST(Text, GroupsThousands) {
  EXPECT_EQ(with_thousands(0), "0");
  EXPECT_EQ(with_thousands(999), "999");
  EXPECT_EQ(with_thousands(1000), "1,000");
  EXPECT_EQ(with_thousands(1234567), "1,234,567");
  EXPECT_EQ(with_thousands(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

TEST(Text, ShortensDecimals) {
  EXPECT_EQ(short_decimal(0), "0");
  EXPECT_EQ(short_decimal(0.00123449), "0.001234");
  EXPECT_EQ(short_decimal(0.0000123449), "0.00001234");
  EXPECT_EQ(short_decimal(0.00000123449), "0.000001234");
  EXPECT_EQ(short_decimal(1.23449e-9), "0.000000001234");
  EXPECT_EQ(short_decimal(1.23449e-10), "1.234e-10");
  EXPECT_EQ(short_decimal(0.12345), "0.123");
  EXPECT_EQ(short_decimal(12.345678), "12.35");
  EXPECT_EQ(short_decimal(123.45678), "123.5");
  EXPECT_EQ(short_decimal(123456.7), "123,457");
  EXPECT_EQ(short_decimal(std::numeric_limits<double>::infinity()), "-");
  EXPECT_EQ(short_decimal(std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_LT(short_decimal(1e300).size(), 12U);
}

TEST(Text, PrintsFingerprintsWithSixteenDigits) { EXPECT_EQ(hex_digits(0xabcdef), "0000000000abcdef"); }

TEST(Text, KeepsMessagesOnOneLine) {
  EXPECT_EQ(one_line("a\nb\tc\x1b[31m\r\n"), "a b c [31m");
  EXPECT_EQ(one_line("h\xc3\xa9lix"), "h\xc3\xa9lix");
}

TEST(Text, SplitsWithEmptyParts) {
  EXPECT_EQ(split("a,,b,", ','), (std::vector<std::string>{"a", "", "b", ""}));
  EXPECT_EQ(split("", ','), std::vector<std::string>{""});
}

TEST(Text, ShellWordsReadBack) {
  EXPECT_EQ(shell_words({"a.xyz", "--radius", "element:fit"}), "a.xyz --radius element:fit");
  EXPECT_EQ(shell_words({"my file", "", "it's"}), R"('my file' '' 'it'\''s')");
}

TEST(Text, ColumnsAreAsWideAsTheirWidestCell) {
  EXPECT_EQ(in_columns({{"name", "n", "peer", "note"}, {"a", "12345", "1", ""}}, "<>"),
            (std::vector<std::string>{"name      n  peer  note", "a     12345     1"}));
  EXPECT_EQ(in_columns({{"a", "b"}, {"long", "longer"}}, "><"),
            (std::vector<std::string>{"   a  b", "long  longer"}));
  EXPECT_TRUE(in_columns({}, "<").empty());
}

}  // namespace
}  // namespace kds::text_test
