#include "motions/base/text_input.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/motions/test_files.h"

namespace kds::text_input_test {
namespace {

TEST(TextInput, NumbersTakeUpTheirField) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("+1.5e3"), 1500);
  EXPECT_EQ(parse_double("-.5"), -0.5);
  EXPECT_EQ(parse_double("0.1"), 0.1);
  for (const char* text : {"", "1.5x", "x", "1,5", "1.5 ", " 1.5", "--1", "+-1", "0x10", "********", "+"})
    EXPECT_FALSE(parse_double(text).has_value()) << text;
}

TEST(TextInput, NumbersAtTheEndsOfTheRange) {
  for (const char* text : {"1e-400", "1e-330", "2e-324", "-0e-400"})
    EXPECT_EQ(parse_double(text), 0.0) << text;
  EXPECT_TRUE(std::signbit(parse_double("-1.5e-330").value()));
  EXPECT_EQ(parse_double("3e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1e90"), 1e-311);
  EXPECT_EQ(parse_double("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_double("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_FALSE(parse_double("1e400").has_value());
  EXPECT_TRUE(parse_double("nan").has_value());
}

TEST(TextInput, Counts) {
  EXPECT_EQ(parse_count("0"), 0U);
  EXPECT_EQ(parse_count("12"), 12U);
  for (const char* text : {"", "-1", "+1", "1.0", "99999999999999999999999", "1 "})
    EXPECT_FALSE(parse_count(text).has_value()) << text;
}

TEST(TextInput, LinesAndFields) {
  std::string_view rest = "a b\r\n\n\tc  d ";
  EXPECT_EQ(next_line(rest), "a b");
  EXPECT_EQ(next_line(rest), "");
  EXPECT_EQ(split_fields(next_line(rest)), (std::vector<std::string_view>{"c", "d"}));
  EXPECT_TRUE(rest.empty());
  EXPECT_TRUE(split_fields("  \t ").empty());
  EXPECT_EQ(trimmed("  a b\r"), "a b");
}

TEST(TextInput, MessagesStayOnOneLine) {
  EXPECT_EQ(in_quotes("a\nb\x01"), "'a?b?'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 60U);
}

TEST(TextInput, ReadsPlainAndCompressedFiles) {
  const std::string text = "one\ntwo\n" + std::string(300000, 'x');
  EXPECT_EQ(read_whole_file(test::write_file("plain", text)), text);
  const auto packed = test::temporary("packed.gz");
  const gzFile out = gzopen(packed.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  EXPECT_EQ(read_whole_file(packed), text);
  const std::string bytes = test::read_bytes(packed);
  const auto cut = test::write_file("cut.gz", std::string_view(bytes).substr(0, bytes.size() / 2));
  test::expect_refused([&] { (void)read_whole_file(cut); }, {"cut.gz", "cannot read"});
}

TEST(TextInput, SaysWhyAFileCannotBeRead) {
  test::expect_refused([] { (void)read_whole_file("no/such/file"); }, {"no/such/file", "cannot open"});
  test::expect_refused([] { (void)read_whole_file(testing::TempDir()); }, {"folder"});
}

}  // namespace
}  // namespace kds::text_input_test
