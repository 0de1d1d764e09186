// Data of pages: bytes as text, and JSON inside a script element.

#include "experiments/output/page_data.h"

#include <gtest/gtest.h>

namespace kds::test::page_data_test {
namespace {

// RFC 4648, section 10.
TEST(PageData, EncodesBase64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

TEST(PageData, HoldsNoTag) {
  EXPECT_EQ(without_tags(R"({"a": "</script><!--"})").find('<'), std::string::npos);
}

}  // namespace
}  // namespace kds::test::page_data_test
