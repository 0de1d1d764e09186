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

// tests/golden/readers.txt has further refusals.
TEST(InstanceFile, RefusesFirstLinesOfOtherFiles) {
  for (const char* text : {"", "2 1\n", "2 1 1 1\n", "a 1 1\n"}) refuse(text, {"d1.txt:1:"});
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
