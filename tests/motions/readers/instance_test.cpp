#include "motions/readers/instance.h"

#include <gtest/gtest.h>

#include "tests/motions/test_files.h"

namespace kds::instance_test {
namespace {

Instance read(std::string_view text) { return read_instance(test::write_file("d1.txt", text)); }

void refuse(std::string_view text, std::initializer_list<std::string_view> parts) {
  test::expect_refused([&] { (void)read(text); }, parts);
}

TEST(InstanceFile, Reads) {
  const Instance instance = read("2 4 1\n1 2  3 4  5 6  7 8\n-1 -2 -3 -4 -5 -6 .5 1e-3\n");
  EXPECT_EQ(instance.columns, 4);
  EXPECT_EQ(instance.degree, 1);
  EXPECT_EQ(instance.dimension(), 3);
  EXPECT_TRUE(instance.weighted());
  ASSERT_EQ(instance.point_count(), 2U);
  EXPECT_EQ(instance.control_point(0, 1, 1), 4);
  EXPECT_EQ(instance.control_point(1, 3, 0), 0.5);
}

TEST(InstanceFile, LineEndsDoNotMatter) {
  EXPECT_EQ(read("1 1 1\r\n1 2\r\n\r\n").point_count(), 1U);
  EXPECT_EQ(read("1 1 1\n1 2").point_count(), 1U);
}

TEST(InstanceFile, ByteOrderMark) {
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "1 1 1\n1 2\n")
                .point_count(),
            1U);
  EXPECT_TRUE(is_instance_file(test::write_file("mark.txt",
                                                "\xEF\xBB\xBF"
                                                "1 1 1\n1 2\n")));
  refuse(std::string_view("\xFE\xFF\0"
                          "1",
                          4),
         {"d1.txt", "UTF-16"});
}

TEST(InstanceFile, Refuses) {
  refuse("", {"d1.txt:1:", "points columns degree"});
  refuse("2 1\n", {"d1.txt:1:"});
  refuse("2 1 1 1\n", {"d1.txt:1:"});
  refuse("a 1 1\n", {"d1.txt:1:"});
  refuse("0 1 1\n", {"d1.txt:1:", "at least 1 point"});
  refuse("1 0 1\n1 2\n", {"d1.txt:1:", "1 to 4 columns"});
  refuse("1 5 1\n1 2\n", {"d1.txt:1:", "1 to 4 columns"});
  refuse("1 1 0\n1\n", {"d1.txt:1:", "degree from 1 to 32"});
  refuse("1 1 33\n1\n", {"d1.txt:1:", "degree from 1 to 32"});
  refuse("2 1 1\n1 2\n3\n", {"d1.txt:3: expected 2 numbers, found 1"});
  refuse("2 1 1\n1 2\n3 4 5\n", {"d1.txt:3: expected 2 numbers, found 3"});
  refuse("2 1 1\n1 2\n", {"d1.txt:3: expected 2 points, found 1"});
  refuse("2 1 1\n1 2\n\n3 4\n", {"d1.txt:3: expected 2 numbers, found 0"});
  refuse("1 1 1\n1 2\n3 4\n", {"d1.txt:3: expected the end"});
  refuse("1 1 1\n1 x\n", {"d1.txt:2:", "'x'"});
  refuse("1 1 1\n1 nan\n", {"d1.txt:2:", "finite"});
  refuse("1 1 1\n1 inf\n", {"d1.txt:2:", "finite"});
  refuse("1 1 1\n1 1e999\n", {"d1.txt:2:", "finite"});
  refuse("18446744073709551615 4 32\n1\n", {"d1.txt:2:"});
  test::expect_refused([] { (void)read_instance("no/such/file"); }, {"no/such/file"});
}

TEST(InstanceFile, IsToldByItsFirstLine) {
  const auto is = [](std::string_view text) { return is_instance_file(test::write_file("x", text)); };
  EXPECT_TRUE(is("20 1 1\n0 1\n"));
  EXPECT_TRUE(is("20 1 1"));
  EXPECT_FALSE(is("20\ncomment\n"));
  EXPECT_FALSE(is("20 1 1.5\n"));
  EXPECT_FALSE(is("20 1 1 1\n"));
  EXPECT_FALSE(is(""));
  EXPECT_FALSE(is_instance_file("no/such/file"));
  EXPECT_FALSE(is_instance_file(testing::TempDir()));
  EXPECT_FALSE(is_instance_file(test::data_file("proteins/2f4k.pdb")));
  EXPECT_FALSE(is_instance_file(test::data_file("trajectories/1l2y.dcd")));
}

}  // namespace
}  // namespace kds::instance_test
